#include "scenario/text/document.hpp"

#include "foundation/text/digits.hpp"
#include "foundation/text/nearest.hpp"
#include "foundation/text/parse_toml.hpp"
#include "foundation/text/toml_text.hpp"
#include "scenario/text/key_near.hpp"
#include "scenario/text/overrides.hpp"
#include "slipfront/error.hpp"

namespace slipfront::scenario {
namespace {

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

}  // namespace slipfront::scenario
