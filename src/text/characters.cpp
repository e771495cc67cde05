#include "text/characters.hpp"

#include <algorithm>
#include <cstdint>
#include <numeric>

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

std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i + 1;
    for (std::size_t j = 0; j < b.size(); ++j) {
      const std::size_t change = diagonal + (a[i] == b[j] ? 0 : 1);
      diagonal = row[j + 1];
      row[j + 1] = std::min({change, row[j] + 1, diagonal + 1});
    }
  }
  return row.back();
}

std::string nearest_or_all(std::string_view name, const std::vector<std::string_view>& known) {
  std::string all;
  std::string_view best;
  std::size_t least = std::max<std::size_t>(2, name.size() / 3) + 1;
  for (const std::string_view candidate : known) {
    all += (all.empty() ? "" : ", ") + std::string(candidate);
    if (name.size() > 64) continue;
    const std::size_t distance = edit_distance(name, candidate);
    if (distance < least) {
      least = distance;
      best = candidate;
    }
  }
  return best.empty() ? all : "'" + std::string(best) + "' (the nearest known key)";
}

namespace {

/// The UTF-8 character of a byte that Windows-1252 uses for punctuation and Latin-1 does not use. Empty for others.
std::string_view punctuation(unsigned char byte) {
  switch (byte) {
    case 0x91:
      return "\xE2\x80\x98";
    case 0x92:
      return "\xE2\x80\x99";
    case 0x93:
      return "\xE2\x80\x9C";
    case 0x94:
      return "\xE2\x80\x9D";
    case 0x96:
      return "\xE2\x80\x93";
    case 0x97:
      return "\xE2\x80\x94";
    default:
      return {};
  }
}

}  // namespace

bool is_utf8(std::string_view text) {
  while (!text.empty()) {
    const std::size_t length = utf8_length(text);
    if (length == 0) return false;
    text.remove_prefix(length);
  }
  return true;
}

std::string from_latin1(std::string_view text) {
  std::string out;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte < 0x80) {
      out += c;
    } else if (const std::string_view mark = punctuation(byte); !mark.empty()) {
      out += mark;
    } else {
      out += static_cast<char>(0xc0 | (byte >> 6));
      out += static_cast<char>(0x80 | (byte & 0x3f));
    }
  }
  return out;
}

std::optional<std::string> lines_in_utf8(std::string_view text) {
  const bool old_ends = text.find('\r') != std::string_view::npos && text.find('\n') == std::string_view::npos;
  if (!old_ends && is_utf8(text)) return std::nullopt;
  std::string out;
  const char end_of_line = old_ends ? '\r' : '\n';
  while (!text.empty()) {
    const std::size_t end = std::min(text.find(end_of_line), text.size());
    const std::string_view line = text.substr(0, end);
    out += is_utf8(line) ? std::string(line) : from_latin1(line);
    if (end < text.size()) out += '\n';
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return out;
}

}  // namespace slipfront
