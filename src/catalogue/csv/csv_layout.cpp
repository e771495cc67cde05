#include "catalogue/csv/csv_layout.hpp"

#include <algorithm>
#include <optional>
#include <tuple>
#include <utility>

#include "foundation/text/csv_records.hpp"
#include "foundation/text/trimmed.hpp"
#include "medium/plain_text.hpp"

namespace slipfront::catalogue {
namespace {

using Role = Column::Role;

constexpr std::size_t most_lines = 300;  // a header is not searched below
constexpr std::size_t longest_title = 80;

struct Record {
  std::vector<std::string> cells;
  std::size_t line;
  bool is_comment;
};

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

std::vector<Record> records_of(std::string_view text, char separator, std::size_t skip_lines) {
  std::vector<Record> records;
  const auto skip = [&](std::string_view line, std::size_t number) {
    if (number <= skip_lines) return true;
    if (!is_comment(line)) return false;
    for_each_record(without_sign(line, separator),
                    [&](std::vector<std::string>&& cells, std::size_t) {
                      records.push_back({std::move(cells), number, true});
                    },
                    {.separator = separator});
    return true;
  };
  for_each_record(text,
                  [&](std::vector<std::string>&& cells, std::size_t line) {
                    records.push_back({std::move(cells), line, false});
                  },
                  {.separator = separator, .skip = skip});
  return records;
}

bool is_known(const std::string& title, const ColumnMap& map) {
  if (title.size() > longest_title) return false;
  if (map.columns.count(std::string(trimmed(title))) > 0) return true;
  try {
    const Column column = parse_column(title);
    return column.is_quantity() || column.is_error();
  } catch (const InputError&) {
    return true;  // a title that is nearly right
  }
}

bool begins_like_number(std::string_view cell) {
  cell = trimmed(cell);
  if (!cell.empty() && std::string_view("+-~<>.").find(cell.front()) != std::string_view::npos)
    cell = trimmed(cell.substr(1));
  return !cell.empty() && cell.front() >= '0' && cell.front() <= '9';
}

bool holds_number(const Record& record) {
  return std::any_of(record.cells.begin(), record.cells.end(),
                     [](const std::string& cell) { return medium::number(cell).has_value(); });
}

/// The number of cells without the blank ones at the end.
std::size_t width(const Record& record) {
  std::size_t n = record.cells.size();
  while (n > 0 && trimmed(record.cells[n - 1]).empty()) --n;
  return n;
}

/// Whether the first row below a header has as many cells, or there is no row.
bool matches_rows(const std::vector<Record>& records, std::size_t header) {
  for (std::size_t i = header + 1; i < records.size(); ++i) {
    const Record& r = records[i];
    if (r.is_comment || std::none_of(r.cells.begin(), r.cells.end(), begins_like_number)) continue;
    return r.cells.size() == records[header].cells.size() || width(r) == width(records[header]);
  }
  return true;
}

struct Candidate {
  bool matches = false;
  std::size_t known = 0;
  std::size_t index = 0;
  bool better_than(const Candidate& other) const {
    return std::tie(matches, known) > std::tie(other.matches, other.known);
  }
};

Candidate find_header(const std::vector<Record>& records, const ColumnMap& map) {
  Candidate best;
  for (std::size_t i = 0; i < records.size(); ++i) {
    const auto& cells = records[i].cells;
    if (holds_number(records[i])) {
      if (best.known > 0 && !records[i].is_comment) break;
      continue;
    }
    Candidate found{.index = i};
    found.known = static_cast<std::size_t>(
        std::count_if(cells.begin(), cells.end(), [&](const std::string& cell) { return is_known(cell, map); }));
    if (found.known == 0) continue;
    found.matches = matches_rows(records, i);
    if ((found.matches || cells.size() > 1) && found.better_than(best)) best = found;
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
    line.erase(
        std::remove_if(line.begin(), line.end(),
                       [](char c) { return std::string_view(" \t\r\n#%'\"").find(c) != std::string_view::npos; }),
        line.end());
    if (line == "decimal:," || line == "decimal=,") return true;
  }
  return false;
}

/// The units of a record below the header. Nothing if it is not a row of units.
std::optional<std::vector<std::string>> units_of(const Record& record, const std::vector<Column>& columns) {
  if (record.cells.size() != columns.size() || holds_number(record)) return std::nullopt;
  std::vector<std::string> units(columns.size());
  bool any = false;
  for (std::size_t i = 0; i < columns.size(); ++i) {
    const std::string unit = medium::plain_unit(record.cells[i]);
    if (!columns[i].key || unit.empty() || unit == "-") continue;
    try {
      medium::unit_factor(unit, columns[i].key->dimension);
    } catch (const InputError&) {
      return std::nullopt;
    }
    if (!columns[i].unit.empty() && columns[i].unit != unit)
      throw InputError({.line = record.line,
                        .key = columns[i].title,
                        .value = record.cells[i],
                        .problem = "another unit than that of the title",
                        .allowed = "one unit"});
    units[i] = unit;
    any = true;
  }
  return any ? std::optional(units) : std::nullopt;
}

std::vector<char> separators(const ColumnMap& map, bool decimal_comma) {
  if (map.separator) return {*map.separator};
  if (decimal_comma) return {';', '\t', '|', ','};
  return {',', '\t', ';', '|'};
}

void read_header(Layout& layout, const std::vector<Record>& records, std::size_t index, const ColumnMap& map) {
  const Record& header = records[index];
  layout.header_line = layout.last_head_line = header.line;
  layout.titles = header.cells;
  try {
    layout.columns = mapped_columns(map, header.cells);
  } catch (const InputError& error) {
    Complaint c = error.complaint();
    if (c.file.empty()) c.line = header.line;
    throw InputError(c);
  }
  if (index + 1 == records.size()) return;
  const auto units = units_of(records[index + 1], layout.columns);
  if (!units) return;
  layout.last_head_line = records[index + 1].line;
  for (std::size_t i = 0; i < units->size(); ++i)
    if (layout.columns[i].unit.empty()) layout.columns[i].unit = (*units)[i];
}

}  // namespace

bool is_comment(std::string_view line) {
  line = trimmed(line);
  return !line.empty() && (line.front() == '#' || line.front() == '%');
}

Layout find_layout(std::string_view text, const ColumnMap& map) {
  const std::string_view head = first_lines(text);
  Layout layout;
  layout.decimal_comma = map.decimal_comma || declares_decimal_comma(head);
  std::vector<Record> records;
  Candidate best;
  std::size_t first_line = 0;
  for (const char separator : separators(map, layout.decimal_comma)) {
    std::vector<Record> found = records_of(head, separator, map.skip_lines);
    if (first_line == 0 && !found.empty()) first_line = found.front().line;
    const Candidate candidate = find_header(found, map);
    if (candidate.known == 0 || !candidate.better_than(best)) continue;
    best = candidate;
    records = std::move(found);
    layout.separator = separator;
  }
  if (best.known == 0)
    throw InputError(
        {.line = first_line,
         .problem = "the header names no observed quantity",
         .allowed = "columns such as name, rupture_velocity_km_s, slip_velocity_m_s; or --columns map.toml"});
  read_header(layout, records, best.index, map);
  return layout;
}

}  // namespace slipfront::catalogue
