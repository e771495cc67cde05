#include "record/netcdf/table_file.hpp"

#include <cmath>
#include <cstddef>
#include <cstring>
#include <filesystem>
#include <optional>
#include <string_view>
#include <system_error>

#include "foundation/text/csv_records.hpp"
#include "foundation/text/digits.hpp"
#include "foundation/text/trimmed.hpp"
#include "record/files/seal.hpp"
#include "record/files/text_file.hpp"
#include "record/netcdf/netcdf_file.hpp"
#include "slipfront/error.hpp"
#include "slipfront/medium/quantity.hpp"

namespace slipfront::record {
namespace {

using Table = std::vector<std::pair<double, double>>;

/// The names of the two columns to read.
struct Names {
  std::string x, y;
  std::string both() const { return x + " and " + y; }
};

/// The number of columns in a CSV file, and the indices of the two to read.
struct Columns {
  std::size_t count, x, y;
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
                        .allowed = "a header line with the columns " + names.both()});
    return *found;
  };
  return {titles.size(), column(names.x), column(names.y)};
}

std::pair<double, double> read_row(const Columns& columns, const Names& names, const std::vector<std::string>& cells,
                                   std::size_t line, const std::string& path) {
  if (cells.size() != columns.count)
    throw InputError({.file = path,
                      .line = line,
                      .problem = "the row has " + std::to_string(cells.size()) + " cells",
                      .allowed = std::to_string(columns.count) + " cells, as in the header"});
  const auto value = [&](const std::string& name, std::size_t column) {
    const std::optional<double> parsed = medium::number(trimmed(cells[column]));
    if (!parsed)
      throw InputError({.file = path,
                        .line = line,
                        .key = name,
                        .value = cells[column],
                        .problem = cells[column].empty() ? "no value" : "not a number",
                        .allowed = "a finite number"});
    return *parsed;
  };
  return {value(names.x, columns.x), value(names.y, columns.y)};
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
                      .allowed = "a header line with the columns " + names.both() + ", and rows of numbers"});
  return table;
}

/// Reads a variable. \throws InputError if it is packed, or if values are missing or not finite.
std::vector<double> read_variable(const netcdf::Reader& file, const std::string& name, const Names& names,
                                  const std::string& path) {
  const auto fail = [&](const std::string& value, const std::string& problem, const std::string& allowed) {
    throw InputError({.file = path, .key = name, .value = value, .problem = problem, .allowed = allowed});
  };
  const std::optional<netcdf::Variable> variable = file.find(name);
  if (!variable) fail("", "variable is missing", "variables " + names.both());
  if (variable->kind == netcdf::Variable::Kind::other) fail("", "holds no numbers", "numbers");
  if (variable->shape.size() != 1)
    fail("", "has " + std::to_string(variable->shape.size()) + " dimensions", "one dimension");
  if (file.number(*variable, "scale_factor") || file.number(*variable, "add_offset"))
    fail("", "is packed (scale_factor, add_offset)", "plain numbers");
  const auto fill = file.number(*variable, "_FillValue"), missing = file.number(*variable, "missing_value");
  std::vector<double> values = file.reals(*variable);
  for (std::size_t i = 0; i < values.size(); ++i) {
    const std::string index = "value " + std::to_string(i + 1) + " of " + std::to_string(values.size());
    if (values[i] == fill || values[i] == missing) fail(digits(values[i]), index + " is missing", "no missing values");
    if (!std::isfinite(values[i])) fail(digits(values[i]), index + " is not finite", "a finite number");
  }
  return values;
}

Table columns_of(const netcdf::Reader& file, const Names& names, const std::string& path) {
  const std::vector<double> x = read_variable(file, names.x, names, path),
                            y = read_variable(file, names.y, names, path);
  if (x.size() != y.size())
    throw InputError({.file = path,
                      .key = names.y,
                      .problem = "has " + std::to_string(y.size()) + " values",
                      .allowed = std::to_string(x.size()) + " values, as " + names.x + " has"});
  if (x.empty()) throw InputError({.file = path, .key = names.x, .problem = "no values", .allowed = "at least one"});
  Table table;
  for (std::size_t i = 0; i < x.size(); ++i) table.emplace_back(x[i], y[i]);
  return table;
}

Table read_any_netcdf(std::string_view image, const Names& names, const std::string& path) {
  constexpr std::size_t most_bytes = std::size_t{1} << 28;  // a compressed file may hold more than its own size
  const std::string bytes = read_netcdf(path, image, most_bytes, [&](const netcdf::Reader& file) {
    const Table table = columns_of(file, names, path);
    return std::string(reinterpret_cast<const char*>(table.data()), table.size() * sizeof table[0]);
  });
  Table table(bytes.size() / sizeof table[0]);
  std::memcpy(static_cast<void*>(table.data()), bytes.data(), bytes.size());
  return table;
}

}  // namespace

std::vector<std::pair<double, double>> read_table(const std::string& path, const std::string& x, const std::string& y) {
  const Names names{x, y};
  const std::string ending = std::filesystem::path(path).extension().string();
  if (ending != ".csv" && ending != ".nc")
    throw InputError({.file = path, .problem = "unknown ending '" + ending + "'", .allowed = ".csv or .nc"});
  const std::string content = read_regular(path);
  return ending == ".csv" ? read_csv(content, names, path)
                          : read_any_netcdf(without_broken_seal(content, path), names, path);
}

}  // namespace slipfront::record
