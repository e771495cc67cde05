#pragma once
/// \file
/// Writing a file whole or not at all.

#include <initializer_list>
#include <string>
#include <string_view>

namespace slipfront::record {

/// Puts a file made of `parts`, one after the other, in the place of `path`: written beside it, brought to the disk,
/// then renamed. Whoever reads `path` finds the old file or the new one; a failure leaves the old one as it was. A link
/// is followed. \throws FileError with path and reason.
void replace_file(const std::string& path, std::initializer_list<std::string_view> parts);

}  // namespace slipfront::record
