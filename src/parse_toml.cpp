#include "parse_toml.hpp"

#include "slipfront/error.hpp"

namespace slipfront {
toml::table parse_toml(std::string_view text, const std::string& file) {
  if (text.substr(0, 3) == "\xEF\xBB\xBF") text.remove_prefix(3);  // byte order mark
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
