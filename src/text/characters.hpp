#pragma once
/// \file
/// Characters and words, whatever the locale is: text from files and users that is safe to show on a terminal, the
/// known name nearest to a mistyped one, and UTF-8 from Latin-1.

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace slipfront {

inline bool is_digit(char c) { return c >= '0' && c <= '9'; }
inline bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }

inline char small_letter(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }

inline std::string small_letters(std::string_view text) {
  std::string small(text);
  for (char& c : small) c = small_letter(c);
  return small;
}

/// A text without the blanks, tabs and line ends around it.
inline std::string_view trimmed(std::string_view text) {
  constexpr std::string_view blanks = " \t\r\n";
  const auto first = text.find_first_not_of(blanks);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

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

/// Number of letters to add, drop or change (Levenshtein).
std::size_t edit_distance(std::string_view a, std::string_view b);

/// The known name nearest to a mistyped one: "'contact_ratio'" or, when none is near, the whole list. For `allowed`.
std::string nearest_or_all(std::string_view name, const std::vector<std::string_view>& known);

bool is_utf8(std::string_view text);

/// Reads bytes as Latin-1, with the dashes and quotation marks of Windows-1252, and returns UTF-8.
std::string from_latin1(std::string_view text);

/// The text in UTF-8, with '\n' at the end of each line. A line that is not UTF-8 is read as Latin-1. Nothing if no
/// change is needed.
std::optional<std::string> lines_in_utf8(std::string_view text);

}  // namespace slipfront
