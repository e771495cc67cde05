#include <algorithm>
#include <set>
#include <tuple>

#include "events/catalogue/csv/csv.hpp"
#include "text/characters.hpp"
#include "text/csv_records.hpp"
#include "text/toml.hpp"
#include "text/units.hpp"

namespace slipfront::catalogue {
namespace {

constexpr std::size_t most_lines = 300;  // a header is not searched below
constexpr std::size_t longest_title = 80;

struct Record {
  std::vector<std::string> cells;
  std::size_t line;
  bool is_comment;

  bool has(bool (*property)(const std::string&)) const { return std::any_of(cells.begin(), cells.end(), property); }
  /// The number of cells without the blank ones at the end.
  std::size_t width() const {
    std::size_t n = cells.size();
    while (n > 0 && trimmed(cells[n - 1]).empty()) --n;
    return n;
  }
};

bool is_number(const std::string& cell) { return medium::number(cell).has_value(); }

bool begins_like_number(const std::string& cell) {
  std::string_view text = trimmed(cell);
  if (!text.empty() && std::string_view("+-~<>.").find(text.front()) != std::string_view::npos)
    text = trimmed(text.substr(1));
  return !text.empty() && is_digit(text.front());
}

std::string_view first_lines(std::string_view text) {
  std::size_t end = 0;
  for (std::size_t line = 0; line < most_lines && end < text.size(); ++line)
    end = std::min(text.find('\n', end), text.size() - 1) + 1;
  return text.substr(0, end);
}

/// The text of a comment. A '#' that is a title of its own stays.
std::string_view without_sign(std::string_view line, char separator) {
  line = trimmed(line);
  if (line.size() > 1 && line[1] == separator) return line;
  while (!line.empty() && (line.front() == '#' || line.front() == '%')) line = trimmed(line.substr(1));
  return line;
}

std::vector<Record> records_of(std::string_view head, char separator, std::size_t skip_lines) {
  std::vector<Record> records;
  const bool by_blanks = separator == ' ';
  const std::string tabbed = by_blanks ? with_tabs(head) : "";
  const RecordOptions options{.separator = by_blanks ? '\t' : separator};
  RecordOptions skipping = options;
  std::size_t comment = 0;  // line of the comment whose cells are taken
  const auto take = [&](std::vector<std::string>&& cells, std::size_t line) {
    records.push_back({std::move(cells), comment > 0 ? comment : line, comment > 0});
  };
  skipping.skip = [&](std::string_view line, std::size_t number) {
    if (number <= skip_lines) return true;
    if (!is_comment(line)) return false;
    comment = number;
    for_each_record(without_sign(line, separator), take, options);
    comment = 0;
    return true;
  };
  for_each_record(by_blanks ? tabbed : head, take, skipping);
  return records;
}

/// The first row below a line. Null if there is none.
const Record* row_below(const std::vector<Record>& records, std::size_t line) {
  for (const Record& r : records)
    if (r.line > line && !r.is_comment && r.has(begins_like_number)) return &r;
  return nullptr;
}

struct Candidate {
  std::vector<Record> records = {};
  char separator = ',';
  std::size_t known = 0;  ///< number of titles that name a quantity
  std::size_t index = 0;  ///< number of the header among the records
  bool matches = false;   ///< the first row has as many cells, or there is no row
};

bool is_known(const std::string& title, const ColumnMap& map) {
  if (title.size() > longest_title) return false;
  if (map.columns.count(std::string(trimmed(title))) > 0) return true;
  const Column column = title_column(title, {}, *map.keys);
  return column.is_quantity() || column.is_error() || column.refusal;  // the last is nearly right
}

/// The line with most titles that are known, above the first row.
Candidate find_header(const std::string_view head, char separator, const ColumnMap& map) {
  Candidate best{.records = records_of(head, separator, map.skip_lines), .separator = separator};
  for (std::size_t i = 0; i < best.records.size(); ++i) {
    const Record& header = best.records[i];
    if (header.has(is_number)) {
      if (best.known > 0 && !header.is_comment) break;
      continue;
    }
    const auto known = static_cast<std::size_t>(std::count_if(header.cells.begin(), header.cells.end(),
                                                              [&](const auto& title) { return is_known(title, map); }));
    const Record* row = row_below(best.records, header.line);
    // Blanks separate many texts. They are the separator only if a row agrees.
    const bool matches = row ? row->cells.size() == header.cells.size() || row->width() == header.width()
                             : separator != ' ' || map.separator;
    const bool may_be = known > 0 && (matches || (header.cells.size() > 1 && (separator != ' ' || map.separator)));
    if (!may_be || std::tie(matches, known) <= std::tie(best.matches, best.known)) continue;
    best.known = known;
    best.index = i;
    best.matches = matches;
  }
  return best;
}

/// "# decimal: ," or "# decimal = ','" in a comment.
bool declares_decimal_comma(std::string_view text) {
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size() - 1) + 1;
    std::string line(text.substr(0, end));
    text.remove_prefix(end);
    if (!is_comment(line)) continue;
    std::erase_if(line, [](char c) { return std::string_view(" \t\r\n#%'\"").find(c) != std::string_view::npos; });
    if (line == "decimal:," || line == "decimal=,") return true;
  }
  return false;
}

/// Takes the units of a record below the header into the columns. Returns false if it is not a row of units.
bool take_units(const Record& record, std::vector<Column>& columns) {
  if (record.cells.size() != columns.size() || record.has(is_number)) return false;
  std::vector<Column> with_units = columns;
  bool any = false;
  for (std::size_t i = 0; i < columns.size(); ++i) {
    Column& column = with_units[i];
    const std::string unit = medium::plain_column_unit(record.cells[i]);
    const bool is_value = begins_like_number(record.cells[i]);
    if (is_value && medium::plain_number(record.cells[i]).find("10^") == std::string::npos) return false;
    if (!column.key || unit.empty() || unit == "-") continue;
    try {
      medium::column_unit_factor(unit, column.key->dimension);
    } catch (const InputError&) {
      return false;
    }
    if (!column.unit.empty() && column.unit != unit)
      column.refusal = {.line = record.line,
                        .key = column.title,
                        .value = record.cells[i],
                        .problem = "another unit than that of the title",
                        .allowed = "one unit"};
    column.unit = unit;
    any = true;
  }
  if (any) columns = std::move(with_units);
  return any;
}

/// The separators that a table may have, the likely ones first. Blanks are tried only if no other fits.
std::vector<char> separators(const ColumnMap& map, bool decimal_comma) {
  if (map.separator) return {*map.separator};
  if (decimal_comma) return {';', '\t', '|', ',', ' '};
  return {',', '\t', ';', '|', ' '};
}

/// A header is not known: the first record has the titles, or the table has none.
Candidate without_header(std::string_view head, const std::vector<char>& separators, const ColumnMap& map) {
  Candidate best;
  for (const char separator : separators) {
    Candidate found{.records = records_of(head, separator, map.skip_lines), .separator = separator};
    while (found.index + 1 < found.records.size() && found.records[found.index].is_comment) ++found.index;
    if (found.records.empty()) continue;
    const auto& cells = found.records[found.index].cells;
    if (best.records.empty() || (separator != ' ' && cells.size() > best.records[best.index].cells.size()) ||
        (separator == ' ' && best.records[best.index].cells.size() == 1))
      best = std::move(found);
  }
  return best;
}

}  // namespace

std::string with_tabs(std::string_view text) {
  std::string out;
  bool in_quotes = false, begins = true;
  for (const char c : text) {
    if (c == '"') in_quotes = !in_quotes;
    const bool is_blank = !in_quotes && (c == ' ' || c == '\t' || c == '\r');
    if (!in_quotes && c == '\n' && !out.empty() && out.back() == '\t') out.pop_back();
    if (!is_blank)
      out += c;
    else if (!begins && out.back() != '\t')
      out += '\t';
    begins = c == '\n' || (begins && is_blank);
  }
  return out;
}

bool is_comment(std::string_view line) {
  line = trimmed(line);
  return !line.empty() && (line.front() == '#' || line.front() == '%');
}

Layout find_layout(std::string_view text, const ColumnMap& map) {
  const std::string_view head = first_lines(text);
  Layout layout;
  layout.decimal_comma = map.decimal_comma || declares_decimal_comma(head);
  const std::vector<char> all = separators(map, layout.decimal_comma);
  Candidate best;
  for (const char separator : all) {
    if (separator == ' ' && best.matches) continue;
    Candidate found = find_header(head, separator, map);
    if (std::tie(found.matches, found.known) > std::tie(best.matches, best.known)) best = std::move(found);
  }
  if (best.known == 0) best = without_header(head, all, map);
  if (best.records.empty()) return layout;
  const Record& header = best.records[best.index];
  layout.separator = best.separator;
  layout.titles = header.cells;
  if (best.known == 0 && header.has(begins_like_number)) {
    layout.last_head_line = header.line - 1;
    for (std::size_t i = 0; i < header.cells.size(); ++i) layout.titles[i] = "column " + std::to_string(i + 1);
  } else {
    layout.header_line = layout.last_head_line = header.line;
  }
  layout.columns = map.columns_of(layout.titles);
  if (layout.header_line == 0 || best.index + 1 == best.records.size()) return layout;
  const Record& below = best.records[best.index + 1];
  if (take_units(below, layout.columns)) layout.last_head_line = below.line;
  // The rows may have another separator than the header, if they do not have that of the header at all.
  const Record* undivided = row_below(best.records, layout.last_head_line);
  if (!undivided || undivided->cells.size() > 1 || header.width() < 2) return layout;
  for (const char separator : all) {
    const auto records = records_of(head, separator, map.skip_lines);
    const Record* row = row_below(records, layout.last_head_line);
    if (!row || row->width() != header.width()) continue;
    layout.separator = separator;
    break;
  }
  return layout;
}

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
