#include "scenario/text/serialize.hpp"

#include "foundation/text/toml_text.hpp"

namespace slipfront::scenario {
namespace {

void write_entries(std::string& out, const toml::table& table, bool top) {
  for (const auto& [key, value] : table)
    if (!top || !value.is_table()) out += toml_key(key.str()) + " = " + toml_text(value) + "\n";
}

}  // namespace

std::string serialize(const toml::table& root, const std::vector<std::string>& overrides) {
  std::string out;
  for (const std::string& text : overrides) out += "# --set " + text + "\n";
  write_entries(out, root, true);
  for (const auto& [key, value] : root) {
    if (!value.is_table()) continue;
    out += "\n[" + toml_key(key.str()) + "]\n";
    write_entries(out, *value.as_table(), false);
  }
  return out;
}

}  // namespace slipfront::scenario
