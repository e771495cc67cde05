#include "runs/record/netcdf/table_file.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <string_view>
#include <utility>

#include "math/digits.hpp"
#include "runs/record/netcdf/netcdf.hpp"
#include "slipfront/error.hpp"
#include "slipfront/text/quantity.hpp"
#include "system/files/whole_file.hpp"
#include "text/characters.hpp"
#include "text/csv_records.hpp"

namespace slipfront::record {
namespace {

using Table = std::vector<std::vector<double>>;  ///< rows
using Names = std::vector<std::string>;          ///< names of the columns to read

std::string in_words(const Names& names) {
  std::string all;
  for (std::size_t i = 0; i < names.size(); ++i)
    all += (i == 0 ? "" : i + 1 < names.size() ? ", " : " and ") + names[i];
  return all;
}

/// The number of columns in a CSV file, and the indices of those to read.
struct Columns {
  std::size_t count;
  std::vector<std::size_t> indices;
};

Columns read_header(const std::vector<std::string>& titles, const Names& names, std::size_t line,
                    const std::string& path) {
  const auto column = [&](const std::string& name) {
    std::optional<std::size_t> found;
    for (std::size_t i = 0; i < titles.size(); ++i) {
      if (trimmed(titles[i]) != name) continue;
      if (found)
        throw InputError({.file = path, .line = line, .key = name, .problem = "column given twice", .allowed = "once"});
      found = i;
    }
    if (!found)
      throw InputError({.file = path,
                        .line = line,
                        .key = name,
                        .problem = "column is missing",
                        .allowed = "a header line with the columns " + in_words(names)});
    return *found;
  };
  Columns columns{titles.size(), {}};
  for (const std::string& name : names) columns.indices.push_back(column(name));
  return columns;
}

std::vector<double> read_row(const Columns& columns, const Names& names, const std::vector<std::string>& cells,
                             std::size_t line, const std::string& path) {
  if (cells.size() != columns.count)
    throw InputError({.file = path,
                      .line = line,
                      .problem = "the row has " + std::to_string(cells.size()) + " cells",
                      .allowed = std::to_string(columns.count) + " cells, as in the header"});
  std::vector<double> row;
  row.reserve(names.size());
  for (std::size_t i = 0; i < names.size(); ++i) {
    const std::string& cell = cells[columns.indices[i]];
    const std::optional<double> parsed = medium::number(trimmed(cell));
    if (!parsed)
      throw InputError({.file = path,
                        .line = line,
                        .key = names[i],
                        .value = cell,
                        .problem = cell.empty() ? "no value" : "not a number",
                        .allowed = "a finite number"});
    row.push_back(*parsed);
  }
  return row;
}

Table read_csv(std::string_view text, const Names& names, const std::string& path) {
  if (text.substr(0, 3) == "\xEF\xBB\xBF") text.remove_prefix(3);
  std::optional<Columns> columns;
  Table table;
  const std::size_t open_quote = for_each_record(text, [&](std::vector<std::string>&& cells, std::size_t line) {
    if (columns) {
      table.push_back(read_row(*columns, names, cells, line, path));
    } else {
      columns = read_header(cells, names, line, path);
    }
  });
  if (open_quote != 0)
    throw InputError({.file = path,
                      .line = open_quote,
                      .problem = "a quote is opened and never closed",
                      .allowed = "\"...\" around a cell"});
  if (table.empty())
    throw InputError({.file = path,
                      .problem = columns ? "a header and no rows" : "the file is empty",
                      .allowed = "a header line with the columns " + in_words(names) + ", and rows of numbers"});
  return table;
}

/// Reads a variable. \throws InputError if it is packed, or if values are missing or not finite.
std::vector<double> read_variable(const netcdf::Reader& file, const netcdf::Variable& variable,
                                  const std::string& path) {
  const auto fail = [&](const std::string& value, const std::string& problem, const std::string& allowed) {
    throw InputError({.file = path, .key = variable.name, .value = value, .problem = problem, .allowed = allowed});
  };
  if (variable.kind == netcdf::Variable::Kind::other) fail("", "holds no numbers", "numbers");
  if (file.number(variable, "scale_factor") || file.number(variable, "add_offset"))
    fail("", "is packed (scale_factor, add_offset)", "plain numbers");
  const auto fill = file.number(variable, "_FillValue"), missing = file.number(variable, "missing_value");
  std::vector<double> values = file.reals(variable);
  for (std::size_t i = 0; i < values.size(); ++i) {
    const std::string index = "value " + std::to_string(i + 1) + " of " + std::to_string(values.size());
    if (values[i] == fill || values[i] == missing) fail(digits(values[i]), index + " is missing", "no missing values");
    if (!std::isfinite(values[i])) fail(digits(values[i]), index + " is not finite", "a finite number");
  }
  return values;
}

/// A variable over two coordinates as rows of the coordinates and the value.
Table rows_of_grid(const std::vector<double>& x, const std::vector<double>& y, const std::vector<double>& values) {
  Table table;
  table.reserve(values.size());
  for (std::size_t i = 0; i < values.size(); ++i) table.push_back({x[i % x.size()], y[i / x.size()], values[i]});
  return table;
}

Table rows_of(const netcdf::Reader& file, const Names& names, const std::string& path) {
  std::vector<std::vector<double>> columns;
  for (const std::string& name : names) {
    const auto fail = [&](const std::string& problem, const std::string& allowed) {
      throw InputError({.file = path, .key = name, .problem = problem, .allowed = allowed});
    };
    const std::optional<netcdf::Variable> variable = file.find(name);
    if (!variable) fail("variable is missing", "variables " + in_words(names));
    const std::size_t rank = variable->shape.size();
    const bool is_grid = rank == 2 && columns.size() == 2;
    if (rank != 1 && !is_grid) fail("has " + std::to_string(rank) + " dimensions", "one dimension");
    if (is_grid && variable->shape != std::vector<std::size_t>{columns[1].size(), columns[0].size()})
      fail("has another shape than its coordinates", name + "(" + names[1] + ", " + names[0] + ")");
    std::vector<double> values = read_variable(file, *variable, path);
    if (values.empty()) fail("no values", "at least one");
    if (is_grid) return rows_of_grid(columns[0], columns[1], values);
    columns.push_back(std::move(values));
  }
  for (std::size_t i = 1; i < columns.size(); ++i)
    if (columns[i].size() != columns[0].size())
      throw InputError({.file = path,
                        .key = names[i],
                        .problem = "has " + std::to_string(columns[i].size()) + " values",
                        .allowed = std::to_string(columns[0].size()) + " values, as " + names[0] + " has"});
  Table table(columns[0].size());
  for (std::size_t row = 0; row < table.size(); ++row)
    for (const std::vector<double>& column : columns) table[row].push_back(column[row]);
  return table;
}

Table read_any_netcdf(std::string_view image, const Names& names, const std::string& path) {
  constexpr std::size_t most_bytes = std::size_t{1} << 28;  // a compressed file may hold more than its own size
  return rows_of(netcdf::Reader(path, image, most_bytes), names, path);
}

}  // namespace

std::vector<std::vector<double>> read_table(const std::string& path, const std::vector<std::string>& columns) {
  return table_of(read_regular(path), path, columns);
}

std::vector<std::vector<double>> table_of(std::string_view content, const std::string& path,
                                          const std::vector<std::string>& columns) {
  const std::string ending = std::filesystem::path(path).extension().string();
  if (ending != ".csv" && ending != ".nc")
    throw InputError({.file = path, .problem = "unknown ending '" + ending + "'", .allowed = ".csv or .nc"});
  return ending == ".csv" ? read_csv(content, columns, path)
                          : read_any_netcdf(without_broken_seal(content, path), columns, path);
}

}  // namespace slipfront::record
