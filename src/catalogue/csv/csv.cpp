#include <algorithm>
#include <optional>

#include "catalogue/csv/csv_header.hpp"
#include "catalogue/format.hpp"
#include "foundation/text/csv_records.hpp"
#include "slipfront/catalogue/read.hpp"

namespace slipfront::catalogue {
namespace {

using Role = Column::Role;

bool blank(const std::string& cell) { return cell.find_first_not_of(" \t\r") == std::string::npos; }

/// The ends of a range given in two columns.
struct Ends {
  const Column* column;
  std::optional<Measured> low, high;
};

/// Reads a cell; what is wrong with it gets the column's title.
template <class Read>
void read_cell(const Column& column, const Read& read) {
  try {
    read();
  } catch (const InputError& error) {
    Complaint c = error.complaint();
    c.key = column.title;
    throw InputError(c);
  }
}

/// A range from its two ends, where the quantity itself was left blank.
void close_ranges(Observation& o, const std::vector<Ends>& ranges) {
  for (const Ends& r : ranges) {
    auto& target = o.*r.column->key->measured;
    if (target) continue;
    const std::string name(r.column->key->name);
    if (!r.low || !r.high) {
      o.warnings.push_back("only one end of the range of " + name + " is known: not used");
    } else if (r.low->low > r.high->high) {
      throw InputError({.key = r.column->title, .problem = "the range runs downwards", .allowed = "min <= max"});
    } else {
      target = Measured{r.low->low, r.high->high};
    }
  }
}

void note_provenance(Observation& o, const Column& column, const std::string& cell) {
  const bool derived = cell.find("computed") != std::string::npos || cell.find("apparent") != std::string::npos;
  if (derived) o.warnings.push_back(std::string(column.key->name) + ": " + cell);
}

/// Adds a cell that is one end of a range to the ends that are there.
void add_end(std::vector<Ends>& ranges, const Column& column, const std::string& cell) {
  Observation end;
  read_cell(column, [&] { store(end, *column.key, cell, column.unit); });
  auto same = std::find_if(ranges.begin(), ranges.end(), [&](const Ends& r) { return r.column->key == column.key; });
  if (same == ranges.end()) same = ranges.insert(ranges.end(), Ends{&column, {}, {}});
  (column.role == Role::range_low ? same->low : same->high) = end.*column.key->measured;
}

void read_into(Observation& o, std::vector<Ends>& ranges, const Column& column, const std::string& cell) {
  switch (column.role) {
    case Role::quantity:
      return read_cell(column, [&] { store(o, *column.key, cell, column.unit); });
    case Role::range_low:
    case Role::range_high:
      return add_end(ranges, column, cell);
    case Role::provenance:
      return note_provenance(o, column, cell);
    case Role::date:
      o.date = cell;
      return;
    case Role::kind:
      o.kind = cell;
      return;
    case Role::citation:
      o.citation = cell;
      return;
    case Role::note:
      o.note = cell;
      return;
    case Role::slip_velocity_is:
      return read_cell(column, [&] { o.slip_velocity_is = friction_ratio::measure_named(cell); });
    case Role::rupture_velocity_is:
      return read_cell(column, [&] { o.rupture_velocity_is = rupture_velocity_meaning(cell); });
    case Role::stress_drop_is:
      return read_cell(column, [&] { o.stress_drop_is = stress_drop_meaning(cell); });
    case Role::front_threshold:
      return read_cell(column, [&] { o.front_threshold = parse_front_threshold(cell); });
    case Role::name:
    case Role::ignored:
      return;
  }
}

Entry read_row(const std::vector<Column>& columns, const std::vector<std::string>& cells, std::size_t line,
               const std::string& file) {
  Entry entry;
  Observation& o = entry.observation;
  o.file = file;
  o.line = line;
  std::vector<Ends> ranges;
  try {
    for (std::size_t i = 0; i < std::min(columns.size(), cells.size()); ++i)
      if (columns[i].role == Role::name && o.name.empty()) o.name = cells[i];
    if (cells.size() != columns.size())
      throw InputError(
          {.problem = "the row has " + std::to_string(cells.size()) + (cells.size() == 1 ? " cell" : " cells"),
           .allowed = std::to_string(columns.size()) + " cells, as in the header"});
    for (std::size_t i = 0; i < columns.size(); ++i)
      if (!blank(cells[i])) read_into(o, ranges, columns[i], cells[i]);
    close_ranges(o, ranges);
  } catch (const InputError& error) {
    entry.error = error.complaint();
    entry.error->file = file;
    entry.error->line = line;
  }
  if (o.name.empty()) o.name = "line " + std::to_string(line);
  return entry;
}

std::vector<Column> read_header(const std::vector<std::string>& titles, std::size_t line, const std::string& file) {
  std::vector<Column> columns;
  try {
    for (const std::string& title : titles) columns.push_back(parse_column(title));
    for (std::size_t i = 0; i < columns.size(); ++i)
      for (std::size_t j = 0; j < i; ++j)
        if (columns[i].title == columns[j].title && !columns[i].title.empty())
          throw InputError({.key = columns[i].title, .problem = "column given twice", .allowed = "each column once"});
    if (std::none_of(columns.begin(), columns.end(),
                     [](const Column& c) { return c.role == Role::quantity || c.role == Role::range_low; }))
      throw InputError({.problem = "the header names no observed quantity",
                        .allowed = "columns such as name, rupture_velocity_km_s, slip_velocity_m_s"});
  } catch (const InputError& error) {
    Complaint c = error.complaint();
    c.file = file;
    c.line = line;
    throw InputError(c);
  }
  return columns;
}

}  // namespace

std::vector<std::string> read_csv(std::string_view text, const std::string& file, const Sink& sink) {
  if (text.substr(0, 3) == "\xEF\xBB\xBF") text.remove_prefix(3);
  std::vector<Column> columns;
  std::size_t rows = 0;
  const auto take = [&](std::vector<std::string>&& cells, std::size_t line) {
    if (columns.empty()) {
      columns = read_header(cells, line, file);
    } else {
      ++rows;
      sink(read_row(columns, cells, line, file));
    }
  };
  std::size_t open_quote = 0;
  try {
    open_quote = for_each_record(text, take);
  } catch (const InputError& error) {
    Complaint c = error.complaint();
    if (c.file.empty()) c.file = file;
    throw InputError(c);
  }
  if (open_quote != 0) {
    Entry entry;
    entry.observation.name = "line " + std::to_string(open_quote);
    entry.error = Complaint{.file = file,
                            .line = open_quote,
                            .problem = "a quote is opened and never closed",
                            .allowed = "\"...\" around a cell"};
    sink(std::move(entry));
  } else if (columns.empty() || rows == 0) {
    throw InputError({.file = file,
                      .problem = columns.empty() ? "the file is empty" : "a header and no rows",
                      .allowed = "a CSV header line and one row an event"});
  }
  std::vector<std::string> ignored;
  for (const Column& c : columns)
    if (c.role == Role::ignored) ignored.push_back(c.title);
  return ignored;
}

extern const Format csv_format;
const Format csv_format{.ending = ".csv", .looks_like = [](std::string_view) { return true; }, .read = read_csv};

}  // namespace slipfront::catalogue
