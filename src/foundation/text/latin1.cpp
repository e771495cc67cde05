#include "foundation/text/latin1.hpp"

#include "foundation/text/printable.hpp"

namespace slipfront {
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
