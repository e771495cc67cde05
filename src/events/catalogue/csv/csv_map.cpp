#include <algorithm>
#include <set>

#include "events/catalogue/csv/csv.hpp"
#include "text/characters.hpp"
#include "text/parse_toml.hpp"
#include "text/toml_text.hpp"
#include "text/units.hpp"

namespace slipfront::catalogue {
namespace {

using Role = Column::Role;

constexpr std::pair<std::string_view, Role> prefixes[] = {{"error above of ", Role::error_above},
                                                          {"error below of ", Role::error_below},
                                                          {"error of ", Role::error},
                                                          {"minimum of ", Role::low},
                                                          {"maximum of ", Role::high},
                                                          {"source of ", Role::how},
                                                          {"", Role::value}};

constexpr std::string_view texts[] = {"ignore", "name",  "date", "year",       "month",
                                      "day",    "start", "end",  "identifier", "study"};

std::vector<std::string_view> meanings(const std::vector<Key>& keys) {
  std::vector<std::string_view> all(std::begin(texts), std::end(texts));
  all.insert(all.end(), text_keys().begin() + 2, text_keys().end());  // name and date are there already
  for (const Key& key : keys) all.push_back(key.name);
  return all;
}

/// Reads "rupture_velocity km/s", "moment 1e19 N m", "error of slip", "name" or "ignore".
Column meaning(const std::string& title, std::string_view text, const std::vector<Key>& keys) {
  const auto known = meanings(keys);
  if (const auto at = std::find(known.begin(), known.end(), text); at != known.end() && !find_key(*at, keys))
    return {.role = *at == "ignore" ? Role::unused : Role::text, .title = title, .text = *at};
  const auto& [prefix, role] = *std::find_if(std::begin(prefixes), std::end(prefixes),
                                             [&](const auto& one) { return text.starts_with(one.first); });
  Column column{.role = role, .title = title};
  text = trimmed(text.substr(prefix.size()));
  const std::string name(text.substr(0, text.find(' ')));
  column.key = find_key(name, keys);
  if (!column.key)
    throw InputError({.value = name, .problem = "unknown quantity", .allowed = nearest_or_all(name, known)});
  column.unit = medium::plain_column_unit(text.substr(name.size()));
  column.in_percent = column.unit == "%" && column.is_error();
  if (column.in_percent) column.unit.clear();
  if (!column.unit.empty()) medium::column_unit_factor(column.unit, column.key->dimension);
  if ((column.role == Role::low || column.role == Role::high) && !column.key->measured)
    throw InputError(
        {.value = name, .problem = "a constant has no range in two columns", .allowed = "error of " + name});
  return column;
}

constexpr std::pair<std::string_view, char> separators_of_map[] = {{",", ','},   {";", ';'}, {"tab", '\t'},
                                                                   {"\t", '\t'}, {"|", '|'}, {" ", ' '}};

std::string text_of(const toml::node& node) {
  if (const auto text = node.value<std::string>()) return std::string(trimmed(*text));
  throw InputError({.problem = "not a text", .allowed = "a text in quotes"});
}

char separator_of(const toml::node& node) {
  const std::string text = node.value_or(std::string());
  for (const auto& [name, separator] : separators_of_map)
    if (text == name) return separator;
  throw InputError({.value = text,
                    .problem = "not a separator",
                    .allowed = R"(",", ";", "|", "tab" or " " (any number of blanks))"});
}

/// Throws the error again, with the key and line of a node of the map.
template <class Read>
void read_at(const std::string& key, const toml::node& node, Read&& read) {
  try {
    read();
  } catch (const InputError& error) {
    Complaint c = error.complaint();
    if (c.key.empty()) c.key = key;
    if (c.line == 0) c.line = line_of(node);
    throw InputError(c);
  }
}

void read_key(ColumnMap& map, const std::string& key, const toml::node& node) {
  if (key == "decimal") {
    const std::string text = text_of(node);
    if (text != "," && text != ".")
      throw InputError({.value = text, .problem = "not a decimal sign", .allowed = "\",\" or \".\""});
    map.decimal_comma = text == ",";
  } else if (key == "separator") {
    map.separator = separator_of(node);
  } else if (key == "skip_lines") {
    const auto count = node.value<std::int64_t>();
    if (!node.is_integer() || !count || *count < 0)
      throw InputError({.problem = "not a number of lines", .allowed = "a whole number >= 0"});
    map.skip_lines = static_cast<std::size_t>(*count);
  } else if (key == "missing") {
    if (!node.is_array()) throw InputError({.problem = "not a list", .allowed = "a list of texts, such as [\"-9\"]"});
    for (const toml::node& entry : *node.as_array()) map.missing.push_back(text_of(entry));
  } else if (key == "columns") {
    if (!node.is_table()) throw InputError({.problem = "not a table", .allowed = "[columns]"});
    for (const auto& [title_node, text] : *node.as_table()) {
      const std::string title(trimmed(title_node.str()));
      read_at("columns." + title, text, [&, &text = text] {
        map.columns.emplace(title, ColumnMap::Meaning{meaning(title, text_of(text), *map.keys), line_of(text)});
      });
    }
  } else {
    throw InputError({.problem = "unknown key",
                      .allowed = nearest_or_all(key, {"columns", "decimal", "separator", "skip_lines", "missing"})});
  }
}

}  // namespace

ColumnMap parse_column_map(const TableOptions& options) {
  ColumnMap map;
  map.file = options.map_file;
  if (options.of_fronts) map.keys = &front_keys();
  if (trimmed(options.map).empty()) return map;
  try {
    for (const auto& [key, node] : parse_toml(options.map, map.file))
      read_at(std::string(key.str()), node,
              [&, &key = key, &node = node] { read_key(map, std::string(key.str()), node); });
  } catch (const InputError& error) {
    Complaint c = error.complaint();
    c.file = map.file;
    throw InputError(c);
  }
  return map;
}

std::string meaning_of(const Column& column) {
  if (column.role == Role::text) return std::string(column.text);
  for (const auto& [prefix, role] : prefixes)
    if (role == column.role) return std::string(prefix) + std::string(column.key->name);
  return {};
}

std::string map_text(const TableDescription& table, const ColumnMap& map) {
  const auto quoted = [](std::string_view text) { return toml_text(toml::value(std::string(text))); };
  std::string all = "# " + printable(table.file) + ": a line without '#' changes how its column is read.\n";
  for (const auto& [name, separator] : separators_of_map)
    if (table.header_line == 0 && separator == table.separator && name != "\t")
      all += "separator = " + quoted(name) + "\n";
  all += "[columns]\n";
  std::set<std::string> titles;
  for (std::size_t i = 0; i < table.columns.size(); ++i) {
    const ColumnDescription& c = table.columns[i];
    const std::string meaning = c.meaning.empty() ? "ignore" : c.unit.empty() ? c.meaning : c.meaning + " " + c.unit;
    const std::string number = std::to_string(i + 1);
    const bool by_number = c.title == "column " + number || !titles.insert(c.title).second;
    const bool is_read_anyway = c.reason.empty() && map.columns.count(number) + map.columns.count(c.title) == 0;
    all += (is_read_anyway ? "# " : "") + (by_number ? number : quoted(c.title));
    all += " = " + quoted(meaning) + (c.reason.empty() ? "" : "  # " + printable(c.reason)) + "\n";
  }
  return all;
}

void check_column_map(const TableOptions& options) { parse_column_map(options); }

std::vector<Column> ColumnMap::columns_of(const std::vector<std::string>& titles) const {
  std::vector<Column> all;
  std::vector<std::string> names;
  names.reserve(titles.size());
  for (const std::string& title : titles) names.emplace_back(trimmed(title));
  std::set<std::string> used;
  for (std::size_t i = 0; i < titles.size(); ++i) {
    const std::string number = std::to_string(i + 1);
    const bool has_number = columns.count(number) > 0 && std::find(names.begin(), names.end(), number) == names.end();
    const auto at = columns.find(has_number ? number : names[i]);
    all.push_back(at == columns.end() ? title_column(titles[i], all, *keys) : at->second.column);
    all.back().title = titles[i];
    if (at != columns.end()) used.insert(at->first);
  }
  for (const auto& [title, meaning] : columns)
    if (used.count(title) == 0)
      throw InputError({.file = file,
                        .line = meaning.line,
                        .key = "columns." + title,
                        .problem = "no column has this title",
                        .allowed = nearest_or_all(title, {names.begin(), names.end()})});
  settle_columns(all);
  return all;
}

}  // namespace slipfront::catalogue
