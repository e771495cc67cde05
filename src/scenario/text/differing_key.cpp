#include <algorithm>
#include <array>
#include <map>

#include "foundation/text/parse_toml.hpp"
#include "foundation/text/toml_text.hpp"
#include "slipfront/scenario/scenario.hpp"

namespace slipfront::scenario {
namespace {

/// Keys that may differ. The title names the overrides, and time.end may be one.
constexpr std::array<std::string_view, 4> free_keys = {"title", "time.end", "output.times", "output.every"};

/// The values of a scenario as TOML text, by "table.key".
std::map<std::string, std::string> values_of(std::string_view text) {
  std::map<std::string, std::string> values;
  const auto add = [&values](const std::string& key, const toml::node& value) {
    if (std::find(free_keys.begin(), free_keys.end(), key) == free_keys.end()) values.emplace(key, toml_text(value));
  };
  for (const auto& [name_node, node] : parse_toml(text, "scenario")) {
    const std::string name(name_node.str());
    if (const auto* table = node.as_table())
      for (const auto& [key, value] : *table) add(name + "." + std::string(key.str()), value);
    else
      add(name, node);
  }
  return values;
}

}  // namespace

std::string differing_key(std::string_view one, std::string_view other) {
  const auto a = values_of(one), b = values_of(other);
  for (const auto& [values, others] : {std::pair{&a, &b}, {&b, &a}})
    for (const auto& [key, text] : *values)
      if (const auto found = others->find(key); found == others->end() || found->second != text) return key;
  return {};
}

}  // namespace slipfront::scenario
