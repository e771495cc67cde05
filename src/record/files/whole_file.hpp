#pragma once
/// \file
/// Writes a file completely or not at all.

#include <functional>
#include <initializer_list>
#include <string>
#include <string_view>

namespace slipfront::record {

/// Appends to the file that is being written. \throws FileError.
using Put = std::function<void(std::string_view)>;

/// Replaces `path` by the file that `write` produces. The new file is written in the same folder, flushed to the disk
/// and then renamed. A reader of `path` finds either the old file or the new one, and a failure leaves the old file
/// unchanged. Links are followed. Part files of killed processes are removed. \throws FileError with path and reason.
void replace_file(const std::string& path, const std::function<void(const Put&)>& write);

/// Like the function above, for a file that consists of `parts`, one after the other.
void replace_file(const std::string& path, std::initializer_list<std::string_view> parts);

/// Checks whether replace_file could replace `path`, as far as that is known without writing. \throws FileError if not.
void require_replaceable(const std::string& path);

/// Removes the part files that killed processes left for `path`, like replace_file. \throws FileError like
/// require_replaceable.
void remove_leftovers(const std::string& path);

}  // namespace slipfront::record
