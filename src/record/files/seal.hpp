#pragma once
/// \file
/// A seal at the end of a file: a magic number, and the length and checksum of all bytes before it. HDF5 ignores bytes
/// after its own, so every NetCDF reader can still open the file. The NetCDF library trusts the bytes that it reads.
/// The seal lets us reject a file that was truncated, damaged or changed before the library sees it.

#include <string>
#include <string_view>

namespace slipfront::record {

/// Returns the seal to append to `content`.
std::string seal(std::string_view content);

/// Returns the content before the seal. \throws FileError with `name` if the seal is missing or broken.
std::string_view sealed_content(std::string_view file, const std::string& name);

/// Like `sealed_content`, but for files that other programs may have written. A file without a seal is accepted whole.
std::string_view without_broken_seal(std::string_view file, const std::string& name);

/// Checks the seal of the file `path`, if it has one. \throws FileError if the file cannot be read or was changed.
void require_unbroken_seal(const std::string& path);

}  // namespace slipfront::record
