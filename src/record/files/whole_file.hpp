#pragma once
/// \file
/// Writing a file whole or not at all.

#include <functional>
#include <initializer_list>
#include <string>
#include <string_view>

namespace slipfront::record {

/// Appends to the file that is being written. \throws FileError.
using Put = std::function<void(std::string_view)>;

/// Puts the file that `write` makes in the place of `path`: written beside it, brought to the disk, then renamed.
/// Whoever reads `path` finds the old file or the new one; a failure leaves the old one as it was. A link is followed.
/// What killed processes left beside `path` is removed. \throws FileError with path and reason.
void replace_file(const std::string& path, const std::function<void(const Put&)>& write);

/// The same of a file made of `parts`, one after the other.
void replace_file(const std::string& path, std::initializer_list<std::string_view> parts);

/// Whether a file could be put in the place of `path`, as far as can be told without touching it. \throws FileError.
void require_replaceable(const std::string& path);

/// Removes what killed processes left beside `path`, as replace_file does. \throws FileError as require_replaceable.
void remove_leftovers(const std::string& path);

}  // namespace slipfront::record
