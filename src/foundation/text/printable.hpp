#pragma once
/// \file
/// Makes text from files and users safe to show on a terminal.

#include <cstddef>
#include <string>
#include <string_view>

namespace slipfront {

/// Length of the UTF-8 character at the front of `text` (RFC 3629), or 0 if there is none.
std::size_t utf8_length(std::string_view text);

/// Returns `text` with '?' for each character that a terminal obeys instead of showing it. These are control characters
/// (escape sequences begin with one), characters that turn the writing direction or have no width, and bytes that are
/// not UTF-8. A longer result is cut between characters to at most `most` bytes, followed by "...".
std::string printable(std::string_view text, std::size_t most = static_cast<std::size_t>(-1));

/// Like `printable`, but a result of more than 2000 bytes loses its middle. A message begins with the name of a file,
/// which may be long, and ends with the reason.
std::string printable_message(std::string_view text);

/// Like `printable`, but for several lines: line breaks and tabs stay.
std::string printable_lines(std::string_view text);

}  // namespace slipfront
