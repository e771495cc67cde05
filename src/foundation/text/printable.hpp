#pragma once
/// \file
/// Text from files and users as it may be shown to a person.

#include <cstddef>
#include <string>
#include <string_view>

namespace slipfront {

/// Length of the UTF-8 character at the front of `text` (RFC 3629), or 0 if there is none.
std::size_t utf8_length(std::string_view text);

/// `text` with '?' for all that a terminal would obey instead of showing it: control characters (escape sequences begin
/// with one), what turns the direction of writing or has no width, and bytes that are not UTF-8. Cut between characters
/// to at most `most` bytes, with "..." behind.
std::string printable(std::string_view text, std::size_t most = static_cast<std::size_t>(-1));

/// The same of several lines: their breaks, and tabs, stay.
std::string printable_lines(std::string_view text);

}  // namespace slipfront
