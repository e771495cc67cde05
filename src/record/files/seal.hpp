#pragma once
/// \file
/// A seal at the end of a file: magic, length and checksum of all that stands before it. HDF5 does not mind bytes after
/// its own, so every NetCDF reader still opens the file; and a file that was cut, damaged or changed is refused before
/// its bytes reach a library that trusts them.

#include <string>
#include <string_view>

namespace slipfront::record {

/// The seal that belongs behind `content`.
std::string seal(std::string_view content);

/// What stands before the seal. \throws FileError with `name` if there is none or it is broken.
std::string_view sealed_content(std::string_view file, const std::string& name);

/// The same of a file that others may have written: without a seal it is taken as it is.
std::string_view without_broken_seal(std::string_view file, const std::string& name);

}  // namespace slipfront::record
