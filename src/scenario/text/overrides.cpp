#include "scenario/text/overrides.hpp"

#include "foundation/text/nearest.hpp"
#include "foundation/text/parse_toml.hpp"
#include "foundation/text/trimmed.hpp"
#include "scenario/text/document.hpp"
#include "slipfront/error.hpp"

namespace slipfront::scenario {
namespace {

constexpr const char* form = "table.key=value, such as friction.coefficient=0.5";

/// An override becomes a comment in the stored text of the scenario, so it must be one line of UTF-8.
bool may_be_comment(const std::string& text) {
  for (const char c : text)
    if ((static_cast<unsigned char>(c) < 0x20 && c != '\t') || c == 0x7F) return false;
  try {
    parse_toml("# " + text, "--set");
    return true;
  } catch (const InputError&) {
    return false;
  }
}

/// Returns a table whose only entry is the value.
toml::table parse_value(const std::string& text) {
  try {
    const std::string line = "value = " + text;
    toml::table parsed = parse_toml(line, "--set");
    if (parsed.size() == 1 && parsed.contains("value")) return parsed;
  } catch (const InputError&) {  // not TOML: a word or a formula
  }
  toml::table word;
  word.insert("value", text);
  return word;
}

void put(toml::table& table, const std::string& key, const std::string& text) {
  const toml::table parsed = parse_value(text);
  parsed.get("value")->visit([&](const auto& value) { table.insert_or_assign(key, value); });
}

/// Returns the table of this name, and creates it if it is missing.
toml::table& table_named(toml::table& root, const std::string& name, const std::string& key, const std::string& text) {
  bool known = false;
  for (const std::string_view table : known_tables()) known = known || table == name;
  if (!known) {
    const std::string allowed = nearest_or_all(name, known_tables());
    throw InputError({.file = "--set", .key = key, .value = text, .problem = "unknown table", .allowed = allowed});
  }
  if (!root.contains(name)) root.insert(name, toml::table{});
  toml::node* const node = root.get(name);
  if (!node->is_table())
    throw InputError({.line = line_of(*node), .key = name, .problem = "not a table", .allowed = "[" + name + "]"});
  return *node->as_table();
}

/// The title describes the file, so we append the overrides to it.
void tell_in_title(toml::table& root, const Overridden& overridden) {
  const auto* const title = root.get_as<std::string>("title");
  if (!title || title->get().empty() || overridden.empty() || overridden.count("title") > 0) return;
  std::string told = title->get();
  const char* separator = " (with ";
  for (const auto& [key, text] : overridden) {
    told += separator + key + "=" + text;
    separator = ", ";
  }
  root.insert_or_assign("title", told + ")");
}

}  // namespace

Overridden apply_overrides(toml::table& root, const std::vector<std::string>& overrides) {
  Overridden overridden;
  for (const std::string& whole : overrides) {
    const auto refuse = [&](const char* problem) {
      return InputError({.file = "--set", .value = whole, .problem = problem, .allowed = form});
    };
    if (!may_be_comment(whole)) throw refuse("not one line of UTF-8");
    const std::size_t equals = whole.find('=');
    if (equals == std::string::npos) throw refuse("there is no '='");
    const std::string key(trimmed(std::string_view(whole).substr(0, equals)));
    const std::string text(trimmed(std::string_view(whole).substr(equals + 1)));
    const std::size_t dot = key.find('.');
    if (key == "title") {
      put(root, key, text);
    } else if (dot == std::string::npos || dot == 0 || dot + 1 == key.size()) {
      throw refuse("the text before '=' is not table.key");
    } else {
      put(table_named(root, key.substr(0, dot), key, text), key.substr(dot + 1), text);
    }
    overridden[key] = text;
  }
  tell_in_title(root, overridden);
  return overridden;
}

}  // namespace slipfront::scenario
