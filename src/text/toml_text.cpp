#include <locale>
#include <sstream>

#include "text/toml.hpp"

namespace slipfront {

std::string toml_document(const toml::table& table) {
  std::ostringstream out;
  out.imbue(std::locale::classic());
  out.exceptions(std::ios::badbit);  // else a text is cut short when memory runs out
  out << toml::toml_formatter(table, toml::toml_formatter::default_flags & ~toml::format_flags::indentation) << '\n';
  return std::move(out).str();
}

std::string toml_text(const toml::node& node) {
  toml::table line;
  line.insert("x", node);
  if (toml::table* table = line["x"].as_table()) table->is_inline(true);
  std::string text = toml_document(line);
  return text.substr(4, text.size() - 5);  // without "x = " and the end of the line
}

}  // namespace slipfront
