#include "scenario/document.hpp"

#include <algorithm>
#include <array>
#include <filesystem>
#include <map>
#include <utility>

#include "math/digits.hpp"
#include "slipfront/error.hpp"
#include "slipfront/scenario/scenario.hpp"
#include "text/characters.hpp"
#include "text/file_kind.hpp"
#include "text/toml.hpp"

namespace slipfront::scenario {

void Errors::throw_if_any() const {
  if (found_.empty()) return;
  std::vector<Complaint> all = found_;
  std::stable_sort(all.begin(), all.end(), [](const Complaint& a, const Complaint& b) { return a.line < b.line; });
  const Complaint first = all.front();
  all.erase(all.begin());
  throw InputError(first, std::move(all));
}

namespace {

bool is_bare(std::string_view name) {
  constexpr std::string_view letters = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-.";
  return !name.empty() && name.size() <= 64 && name.find_first_not_of(letters) == std::string_view::npos;
}

/// The "table.key" to which a parser's error in `line` most likely refers, or "" if the text does not show it.
std::string key_near(std::string_view text, std::size_t line) {
  std::string_view table;
  std::string_view key;
  for (std::size_t number = 1; number <= line && !text.empty(); ++number) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    const std::string_view row = trimmed(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
    const std::string_view name = trimmed(row.substr(0, row.find('=')));
    const std::size_t close = row.find(']');
    if (row.find('=') != std::string_view::npos && is_bare(name)) {
      key = name;
    } else if (row.size() > 1 && row.front() == '[' && close != std::string_view::npos &&
               is_bare(row.substr(1, close - 1))) {
      table = row.substr(1, close - 1);
      key = {};
    }
  }
  if (key.empty()) return std::string(table);
  return (table.empty() ? "" : std::string(table) + ".") + std::string(key);
}

/// The text after '=' in the last override of each key "table.key".
using Overridden = std::map<std::string, std::string, std::less<>>;

constexpr const char* override_form = "table.key=value, such as friction.coefficient=0.5";

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

/// Applies each "table.key=value" to `root`, in order. A value that is not TOML counts as a text, so that words and
/// formulas need no quotes inside those of the shell. A title that is not overridden itself gets the suffix
/// " (with table.key=value, ...)". \throws InputError (file "--set") for an invalid override or an unknown table.
Overridden apply_overrides(toml::table& root, const std::vector<std::string>& overrides) {
  Overridden overridden;
  for (const std::string& whole : overrides) {
    const auto refuse = [&](const char* problem) {
      return InputError({.file = "--set", .value = whole, .problem = problem, .allowed = override_form});
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

Value convert(const toml::node& node, bool overridden) {
  Value value{.line = overridden ? 0 : line_of(node), .overridden = overridden};
  if (const auto* text = node.as_string()) {
    value.kind = Value::Kind::text;
    value.text = text->get();
  } else if (node.is_number()) {
    value.kind = Value::Kind::number;
    const auto* integer = node.as_integer();
    value.number = integer ? static_cast<double>(integer->get()) : node.as_floating_point()->get();
    value.text = integer ? std::to_string(integer->get()) : shortest(value.number);
  } else if (const auto* truth = node.as_boolean()) {
    value.kind = Value::Kind::truth;
    value.number = truth->get() ? 1 : 0;
    value.text = truth->get() ? "true" : "false";
  } else if (const auto* array = node.as_array()) {
    value.kind = Value::Kind::array;
    for (const toml::node& item : *array) value.items.push_back(convert(item, overridden));
  } else if (const auto* table = node.as_table()) {
    value.kind = Value::Kind::table;
    for (const auto& [name, item] : *table) {
      value.names.emplace_back(name.str());
      value.items.push_back(convert(item, overridden));
    }
  }
  return value;
}

Table convert_table(const toml::table& from, const std::string& name, const Overridden& overridden) {
  Table table{.line = line_of(from)};
  for (const auto& [key_node, node] : from) {
    const std::string key(key_node.str());
    const auto mark = overridden.find(name + "." + key);
    Value value = convert(node, mark != overridden.end());
    if (value.overridden) value.text = value.kind == Value::Kind::text ? value.text : mark->second;
    table.values.emplace(key, std::move(value));
  }
  return table;
}

void convert_document(Document& document, const toml::table& root, const Overridden& overridden) {
  for (const auto& [key_node, node] : root) {
    const std::string key(key_node.str());
    const auto refuse = [&, &value = node](const char* problem, const std::string& allowed) {
      document.errors.add(InputError({.line = line_of(value), .key = key, .problem = problem, .allowed = allowed}));
    };
    if (key == "title") {
      document.title = convert(node, overridden.count(key) > 0);
      continue;
    }
    std::vector<std::string_view> known = known_tables();
    known.insert(known.end(), {"title", "event"});
    bool is_known = false;
    for (const std::string_view name : known) is_known = is_known || name == key;
    if (!is_known) {
      refuse(node.is_table() ? "unknown table" : "unknown key", nearest_or_all(key, known));
    } else if (!node.is_table()) {
      refuse("not a table", "[" + key + "]");
    } else if (key != "event") {
      document.tables.emplace(key, convert_table(*node.as_table(), key, overridden));
    }
  }
}

toml::table parse(std::string_view text, const std::string& file) {
  try {
    return parse_toml(text, file);
  } catch (const InputError& error) {
    Complaint complaint = error.complaint();
    complaint.key = key_near(text, complaint.line);
    complaint.allowed = "TOML 1.0, numbers within the range of a double";
    throw InputError(complaint);
  }
}

}  // namespace

const std::vector<std::string_view>& known_tables() {
  static const std::vector<std::string_view> names = {"initial", "friction", "forcing",    "loading", "interface",
                                                      "domain",  "plane",    "nucleation", "time",    "pulse",
                                                      "chain",   "medium",   "output"};
  return names;
}

Document read_document(std::string_view text, const std::string& file, const std::vector<std::string>& overrides) {
  refuse_other_kinds(text, file, ReadAs::scenario);
  toml::table root = parse(text, file);
  const Overridden overridden = apply_overrides(root, overrides);
  Document document{.file = file, .text = std::string(text), .title = {}, .tables = {}};
  convert_document(document, root, overridden);
  if (!overrides.empty()) {
    document.text.clear();
    for (const std::string& override : overrides) document.text += "# --set " + override + "\n";
    document.text += toml_document(root);
    parse_toml(document.text, file);  // written in another form, it must still be readable
  }
  return document;
}

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

namespace {

/// As a shell takes it for one word.
std::string shell_word(std::string_view word) {
  constexpr std::string_view plain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-+./:,=@%";
  if (!word.empty() && word.find_first_not_of(plain) == std::string_view::npos) return std::string(word);
  std::string text = "'";
  for (const char c : word) {
    if (c == '\'')
      text += "'\\''";
    else
      text += c;
  }
  return text + "'";
}

}  // namespace

std::string command_line(const Scenario& scenario, std::string_view command, const std::vector<double>& scales) {
  std::string line = "slipfront " + std::string(command) + " " + shell_word(scenario.file);
  for (const std::string& text : scenario.overrides) line += " --set " + shell_word(text);
  if (scenario.in_si != scenario.results_in.has_value()) line += scenario.in_si ? " --dimensionless" : " --si";
  for (const double scale : scales) line += " --scale " + shortest(scale);
  return line;
}

std::vector<std::string> files_of(const Scenario& scenario) {
  std::vector<std::string> files = {scenario.file};
  const std::filesystem::path folder = std::filesystem::path(scenario.file).parent_path();
  const Document document = read_document(scenario.text, scenario.file, {});
  const auto add = [&](const std::string& file) { files.push_back((folder / file).string()); };
  for (const auto& [name, table] : document.tables)
    for (const auto& [key, value] : table.values) {
      if (key == "file") add(value.text);
      for (std::size_t i = 0; i < value.names.size(); ++i)
        if (value.names[i] == "file") add(value.items[i].text);
    }
  return files;
}

}  // namespace slipfront::scenario
