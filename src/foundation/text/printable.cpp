#include "foundation/text/printable.hpp"

#include <algorithm>
#include <cstdint>

namespace slipfront {
namespace {

/// The code point of the single UTF-8 character in `bytes`.
std::uint32_t code_point(std::string_view bytes) {
  const auto at = [&](std::size_t i) { return static_cast<std::uint32_t>(static_cast<unsigned char>(bytes[i])); };
  if (bytes.size() == 1) return at(0);
  std::uint32_t code = at(0) & (0xffu >> (bytes.size() + 1));
  for (std::size_t i = 1; i < bytes.size(); ++i) code = (code << 6) | (at(i) & 0x3f);
  return code;
}

bool is_shown(std::uint32_t code) {
  struct Range {
    std::uint32_t first, last;
  };
  // Control characters (C0 and C1); marks, embeddings, overrides and isolates that set the writing direction;
  // separators; characters without width; annotations; tags.
  constexpr Range hidden[] = {{0x00, 0x1f},     {0x7f, 0x9f},     {0xad, 0xad},      {0x61c, 0x61c},
                              {0x180e, 0x180e}, {0x200b, 0x200f}, {0x2028, 0x202e},  {0x2060, 0x206f},
                              {0xfeff, 0xfeff}, {0xfff0, 0xfffb}, {0xe0000, 0xe0fff}};
  return std::none_of(std::begin(hidden), std::end(hidden),
                      [code](const Range& range) { return range.first <= code && code <= range.last; });
}

bool is_plain(char c) { return c >= 0x20 && c < 0x7f; }

std::string shown(std::string_view text, std::size_t most, bool lines) {
  if (text.size() <= most && std::all_of(text.begin(), text.end(), [lines](char c) {
        return is_plain(c) || (lines && (c == '\n' || c == '\t'));
      }))
    return std::string(text);
  std::string out;
  while (!text.empty()) {
    const std::size_t length = utf8_length(text);
    const std::string_view character = text.substr(0, length > 0 ? length : 1);
    const bool stays =
        length > 0 && (is_shown(code_point(character)) || (lines && (character == "\n" || character == "\t")));
    if (out.size() + (stays ? length : 1) > most) return out + "...";
    stays ? out.append(character) : out.append("?");
    text.remove_prefix(character.size());
  }
  return out;
}

}  // namespace

std::size_t utf8_length(std::string_view text) {
  if (text.empty()) return 0;
  const auto at = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned char first = at(0);
  if (first < 0x80) return 1;
  const std::size_t length = first >= 0xf0 ? 4 : first >= 0xe0 ? 3 : 2;
  if (first < 0xc2 || first > 0xf4 || text.size() < length) return 0;
  for (std::size_t i = 1; i < length; ++i)
    if ((at(i) & 0xc0) != 0x80) return 0;
  // Reject overlong forms, surrogates, and code points above U+10FFFF.
  if ((first == 0xe0 && at(1) < 0xa0) || (first == 0xed && at(1) > 0x9f)) return 0;
  if ((first == 0xf0 && at(1) < 0x90) || (first == 0xf4 && at(1) > 0x8f)) return 0;
  return length;
}

std::string printable(std::string_view text, std::size_t most) { return shown(text, most, false); }

std::string printable_message(std::string_view text) {
  constexpr std::size_t most = 2000, begin = 800, end = 800;
  if (text.size() <= most) return printable(text);
  std::string_view rest = text.substr(text.size() - end);
  for (int i = 0; i < 3 && (rest.front() & 0xc0) == 0x80; ++i) rest.remove_prefix(1);  // within a character
  return printable(text.substr(0, text.size() - end), begin) + printable(rest);
}

std::string printable_lines(std::string_view text) { return shown(text, static_cast<std::size_t>(-1), true); }

}  // namespace slipfront
