#include "catalogue/csv/csv_map.hpp"

#include <algorithm>
#include <utility>

#include "foundation/text/nearest.hpp"
#include "foundation/text/parse_toml.hpp"
#include "foundation/text/trimmed.hpp"
#include "medium/plain_text.hpp"
#include "slipfront/catalogue/read.hpp"

namespace slipfront::catalogue {
namespace {

using Role = Column::Role;

constexpr std::pair<std::string_view, Role> prefixes[] = {{"error above of ", Role::error_above},
                                                          {"error below of ", Role::error_below},
                                                          {"error of ", Role::error},
                                                          {"minimum of ", Role::range_low},
                                                          {"maximum of ", Role::range_high}};
constexpr std::pair<std::string_view, Role> texts[] = {{"ignore", Role::unused},
                                                       {"name", Role::name},
                                                       {"date", Role::date},
                                                       {"year", Role::year},
                                                       {"month", Role::month},
                                                       {"day", Role::day},
                                                       {"kind", Role::kind},
                                                       {"citation", Role::citation},
                                                       {"note", Role::note},
                                                       {"slip_velocity_is", Role::slip_velocity_is},
                                                       {"rupture_velocity_is", Role::rupture_velocity_is},
                                                       {"stress_drop_is", Role::stress_drop_is},
                                                       {"front_threshold", Role::front_threshold}};

std::vector<std::string_view> meanings() {
  std::vector<std::string_view> all;
  for (const auto& [name, role] : texts) all.push_back(name);
  for (const Key& key : quantity_keys()) all.push_back(key.name);
  return all;
}

/// Reads "rupture_velocity km/s", "error of slip" or "ignore".
Column meaning_of(const std::string& title, std::string_view text) {
  text = trimmed(text);
  for (const auto& [name, role] : texts)
    if (text == name) return {.role = role, .title = title};
  Column column{.role = Role::quantity, .title = title};
  for (const auto& [prefix, role] : prefixes) {
    if (!text.starts_with(prefix)) continue;
    column.role = role;
    text = trimmed(text.substr(prefix.size()));
    break;
  }
  const std::string name(text.substr(0, text.find(' ')));
  column.key = find_key(name);
  if (!column.key)
    throw InputError({.value = name, .problem = "unknown quantity", .allowed = nearest_or_all(name, meanings())});
  column.unit = medium::plain_unit(text.substr(name.size()));
  if (column.unit == "%" && column.is_error()) {
    column.in_percent = true;
    column.unit.clear();
  }
  if (!column.unit.empty()) medium::unit_factor(column.unit, column.key->dimension);
  if ((column.role == Role::range_low || column.role == Role::range_high) && !column.key->measured)
    throw InputError(
        {.value = name, .problem = "a constant has no range in two columns", .allowed = "error of " + name});
  return column;
}

std::string text_of(const toml::node& node) {
  if (const auto text = node.value<std::string>()) return *text;
  throw InputError({.problem = "not a text", .allowed = "a text in quotes"});
}

char separator_of(const std::string& text) {
  for (const auto& [name, separator] :
       {std::pair<std::string_view, char>{",", ','}, {";", ';'}, {"tab", '\t'}, {"\t", '\t'}, {"|", '|'}})
    if (text == name) return separator;
  throw InputError({.value = text, .problem = "not a separator", .allowed = "\",\", \";\", \"|\" or \"tab\""});
}

void read_key(ColumnMap& map, const std::string& key, const toml::node& node) {
  if (key == "decimal") {
    const std::string text = text_of(node);
    if (text != "," && text != ".")
      throw InputError({.value = text, .problem = "not a decimal sign", .allowed = "\",\" or \".\""});
    map.decimal_comma = text == ",";
  } else if (key == "separator") {
    map.separator = separator_of(text_of(node));
  } else if (key == "skip_lines") {
    const auto count = node.value<std::int64_t>();
    if (!node.is_integer() || !count || *count < 0)
      throw InputError({.problem = "not a number of lines", .allowed = "a whole number >= 0"});
    map.skip_lines = static_cast<std::size_t>(*count);
  } else if (key == "missing") {
    if (!node.is_array()) throw InputError({.problem = "not a list", .allowed = "a list of texts, such as [\"-9\"]"});
    for (const toml::node& entry : *node.as_array()) map.missing.push_back(text_of(entry));
  } else {
    throw InputError({.problem = "unknown key",
                      .allowed = nearest_or_all(key, {"columns", "decimal", "separator", "skip_lines", "missing"})});
  }
}

void read_columns(ColumnMap& map, const toml::table& table) {
  for (const auto& [key, node] : table) {
    const std::string title(trimmed(key.str()));
    try {
      map.columns.emplace(title, meaning_of(title, text_of(node)));
      map.lines.emplace(title, line_of(node));
    } catch (const InputError& error) {
      Complaint c = error.complaint();
      c.key = "columns." + title;
      c.line = line_of(node);
      throw InputError(c);
    }
  }
}

void read_document(ColumnMap& map, const toml::table& document) {
  for (const auto& [key_node, node] : document) {
    const std::string key(key_node.str());
    if (key == "columns" && node.is_table()) {
      read_columns(map, *node.as_table());
      continue;
    }
    try {
      if (key == "columns") throw InputError({.problem = "not a table", .allowed = "[columns]"});
      read_key(map, key, node);
    } catch (const InputError& error) {
      Complaint c = error.complaint();
      c.key = key;
      c.line = line_of(node);
      throw InputError(c);
    }
  }
}

}  // namespace

ColumnMap parse_column_map(std::string_view text, const std::string& file) {
  ColumnMap map;
  map.file = file;
  if (trimmed(text).empty()) return map;
  try {
    read_document(map, parse_toml(text, file));
  } catch (const InputError& error) {
    Complaint c = error.complaint();
    c.file = file;
    throw InputError(c);
  }
  return map;
}

void check_column_map(const TableOptions& options) { parse_column_map(options.map, options.map_file); }

std::vector<Column> mapped_columns(const ColumnMap& map, const std::vector<std::string>& titles) {
  std::vector<std::string> others = titles;
  std::vector<std::string_view> known;
  for (std::string& title : others) {
    title = trimmed(title);
    known.push_back(title);
  }
  for (const auto& [title, column] : map.columns)
    if (std::find(others.begin(), others.end(), title) == others.end())
      throw InputError({.file = map.file,
                        .line = map.lines.at(title),
                        .key = "columns." + title,
                        .problem = "no column has this title",
                        .allowed = nearest_or_all(title, known)});
  std::vector<Column> columns;
  for (const std::string& title : titles) {
    const auto at = map.columns.find(std::string(trimmed(title)));
    columns.push_back(at != map.columns.end() ? at->second : parse_column(title, columns));
  }
  settle_columns(columns);
  return columns;
}

}  // namespace slipfront::catalogue
