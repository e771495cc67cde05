#include <algorithm>
#include <cmath>

#include "events/catalogue/format.hpp"
#include "events/catalogue/fsp/fsp.hpp"
#include "events/catalogue/subfaults/subfaults.hpp"
#include "text/characters.hpp"

/// \file
/// Formats that have one subfault a row: .param of the USGS, .rupt of MudPy, and CSV as GeoClaw reads it.

namespace slipfront::catalogue::subfaults {
namespace {

using Cells = std::vector<std::string_view>;

/// Calls `take` with each line that is not blank, and its number.
template <class Take>
void for_each_text_line(std::string_view text, const Take& take) {
  for (std::size_t number = 1; !text.empty(); ++number)
    if (const std::string_view line = trimmed(take_line(text)); !line.empty()) take(line, number);
}

Cells split(std::string_view line, char separator) {
  if (separator == ' ') return fsp::words(line);
  Cells cells;
  for (std::size_t end = 0; end != std::string_view::npos;) {
    end = line.find(separator);
    cells.push_back(trimmed(line.substr(0, end)));
    if (end != std::string_view::npos) line.remove_prefix(end + 1);
  }
  return cells;
}

std::vector<Column> columns_of(const Cells& cells, Units units, const std::string& file, std::size_t line) try {
  std::vector<Column> columns;
  for (const std::string_view title : cells) columns.push_back(column_of(title, units));
  return columns;
} catch (const InputError& error) {
  Complaint complaint = error.complaint();
  complaint.file = file, complaint.line = line;
  throw InputError(complaint);
}

/// The number that follows `key` and an equals sign or colon, as in "Dx= 15.00km".
double after(std::string_view line, std::string_view key) {
  const std::size_t at = line.find(key);
  if (at == std::string_view::npos) return none;
  std::string_view rest = trimmed(line.substr(at + key.size()));
  if (rest.starts_with('=') || rest.starts_with(':')) rest = trimmed(rest.substr(1));
  std::size_t size = 0;
  while (size < rest.size() && (is_digit(rest[size]) || rest[size] == '.' || rest[size] == '-')) ++size;
  return fsp::number(rest.substr(0, size)).value_or(none);
}

std::size_t count_after(std::string_view line, std::string_view key) {
  const double count = after(line, key);
  return count >= 1 && count <= 1e6 ? static_cast<std::size_t>(count) : 0;
}

[[noreturn]] void refuse_cut(const std::string& file, std::size_t line, std::size_t found, std::size_t announced,
                             const char* what) {
  throw InputError({.file = file,
                    .line = line,
                    .problem = std::to_string(found) + what + ": the file is cut short",
                    .allowed = std::to_string(announced) + ", as announced"});
}

/// Segments of "#Fault_segment", each with its columns after "#Lat.". The rows after "#Lon." are its outline.
Table read_param(std::string_view text, const std::string& file) {
  Table table{.file = file, .format = ".param of the USGS"};
  std::vector<Column> columns;
  double announced = none, length = none, width = none;
  std::size_t last = 0, begin = 0;
  const auto end_segment = [&] {
    if (table.grids.empty()) return;
    const Grid& grid = table.grids.back();
    const std::size_t rows = table.rows.size() - begin;
    if (rows < grid.along_strike * grid.down_dip)
      refuse_cut(file, last, rows, grid.along_strike * grid.down_dip, " subfaults in this segment");
    begin = table.rows.size();
  };
  for_each_text_line(text, [&](std::string_view line, std::size_t number) {
    last = number;
    if (line.starts_with("#Total number of fault_segments")) {
      announced = after(line, "fault_segments");
    } else if (line.starts_with("#Fault_segment")) {
      end_segment();
      columns.clear();
      table.grids.push_back({count_after(line, "nx(Along-strike)"), count_after(line, "ny(downdip)")});
      length = 1000 * after(line, "Dx"), width = 1000 * after(line, "Dy");
    } else if (line.starts_with("#Boundary")) {
      if (std::isnan(table.longitude)) table.longitude = after(line, "Lon"), table.latitude = after(line, "Lat");
    } else if (line.starts_with("#Lat")) {
      columns = columns_of(split(line.substr(1), ' '), Units::param, file, number);
    } else if (!line.starts_with('#') && !columns.empty()) {
      Row& row = table.rows.emplace_back(row_of(split(line, ' '), columns, file, number));
      row.segment = static_cast<double>(table.grids.size());
      row.length = length, row.width = width;
    }
  });
  end_segment();
  if (announced > static_cast<double>(table.grids.size()))
    refuse_cut(file, last, table.grids.size(), static_cast<std::size_t>(std::fmin(announced, 1e9)), " segments");
  return table;
}

Table read_rupt(std::string_view text, const std::string& file) {
  Table table{.file = file, .format = ".rupt of MudPy"};
  std::vector<Column> columns;
  for_each_text_line(text, [&](std::string_view line, std::size_t number) {
    if (!line.starts_with('#'))
      table.rows.push_back(row_of(split(line, ' '), columns, file, number));
    else if (columns.empty())
      columns = columns_of(split(line.substr(1), ','), Units::si, file, number);
  });
  return table;
}

/// The first line that is no comment.
std::string_view header_of(std::string_view text) {
  std::string_view header;
  for_each_text_line(text.substr(0, 4000), [&](std::string_view line, std::size_t) {
    if (header.empty() && !line.starts_with('#')) header = line;
  });
  return header;
}

Table read_csv_subfaults(std::string_view text, const std::string& file) {
  Table table{.file = file, .format = "CSV of subfaults", .tops = true};
  std::vector<Column> columns;
  for_each_text_line(text, [&](std::string_view line, std::size_t number) {
    if (line.starts_with('#')) {
      const std::string words = small_letters(line);
      if (words.find("centroid") != std::string::npos || words.find("positions are centres") != std::string::npos)
        table.tops = false;
    } else if (columns.empty()) {
      columns = columns_of(split(line, ','), Units::si, file, number);
    } else {
      table.rows.push_back(row_of(split(line, ','), columns, file, number));
    }
  });
  return table;
}

/// Whether the titles are those of subfaults, and of nothing that describes an event.
bool is_csv_of_subfaults(std::string_view text) {
  Row seen;
  for (const std::string_view title : split(header_of(text), ',')) try {
      const std::string small = small_letters(title);
      for (const char* of_event : {"name", "date", "event", "magnitude", "duration", "velocity", "stress"})
        if (small.find(of_event) != std::string::npos) return false;
      if (const Column column = column_of(title, Units::si); column.member) seen.*column.member = 1;
    } catch (const InputError&) {  // the reader reports the wrong unit
    }
  const double all =
      seen.longitude * seen.latitude * seen.depth * seen.strike * seen.dip * seen.slip * seen.length * seen.width;
  return all == 1;
}

bool has(std::string_view text, std::string_view part) {
  return text.substr(0, 4000).find(part) != std::string_view::npos;
}

}  // namespace

const FaultFormat param_format{[](std::string_view text) { return has(text, "#Fault_segment"); }, read_param};
const FaultFormat rupt_format{
    [](std::string_view text) { return has(text, "ss-slip") && trimmed(text).starts_with('#'); }, read_rupt};
const FaultFormat csv_format{is_csv_of_subfaults, read_csv_subfaults};

}  // namespace slipfront::catalogue::subfaults
