#include "parse_toml.hpp"

#include "slipfront/error.hpp"

namespace slipfront {
namespace {

/// Position of a character from U+FB26 to U+FEFF: outside a text value, one of these walks toml++ 3.3 into undefined
/// behaviour.
std::size_t find_forbidden(std::string_view text) {
  for (std::size_t i = 0; i + 2 < text.size(); ++i) {
    const auto byte = [&](std::size_t k) { return static_cast<unsigned char>(text[i + k]); };
    if (byte(0) != 0xEF) continue;
    const unsigned code = 0xF000u | ((byte(1) & 0x3Fu) << 6) | (byte(2) & 0x3Fu);
    if (code >= 0xFB26 && code <= 0xFEFF) return i;
  }
  return std::string_view::npos;
}

}  // namespace

toml::table parse_toml(std::string_view text, const std::string& file) {
  if (text.substr(0, 3) == "\xEF\xBB\xBF") text.remove_prefix(3);  // byte order mark
  if (const std::size_t at = find_forbidden(text); at != std::string_view::npos) {
    std::size_t line = 1;
    for (const char c : text.substr(0, at)) line += c == '\n' ? 1 : 0;
    throw InputError({.file = file,
                      .line = line,
                      .problem = "a character from U+FB26 to U+FEFF",
                      .allowed = "any other (presentation forms are not read)"});
  }
  try {
    return toml::parse(text, file);
  } catch (const toml::parse_error& error) {
    throw InputError({.file = file,
                      .line = error.source().begin.line,
                      .problem = std::string(error.description()),
                      .allowed = "TOML 1.0"});
  }
}

}  // namespace slipfront
