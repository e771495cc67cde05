#include "scenario/profile/table.hpp"

#include <filesystem>

#include "foundation/text/digits.hpp"

namespace slipfront::scenario {
namespace {

std::string in_words(const Column& column) {
  return column.limits.text() +
         (column.unit == 1 ? "" : ", in the unit of the model, which is " + shortest(column.unit));
}

}  // namespace

std::vector<std::vector<double>> read_columns(const Section& section, const TableReader& tables,
                                              const std::vector<Column>& columns) {
  const auto refuse = [&](const std::string& problem, const std::string& allowed) {
    return section.refuse("file", problem, allowed);
  };
  const std::string file = *section.text("file");
  // Relative to the scenario, wherever the program was started; an absolute path stays what it is.
  const std::string path = (std::filesystem::path(section.file()).parent_path() / file).string();
  if (file.empty() || path.find('\0') != std::string::npos) throw refuse("not a path", "a file");
  if (!tables) throw refuse("a table cannot be read here", "a formula");
  std::vector<std::string> names;
  names.reserve(columns.size());
  for (const Column& column : columns) names.push_back(column.name);
  std::vector<std::vector<double>> rows = tables(path, names);
  if (rows.size() < 2) throw refuse("a table of " + std::to_string(rows.size()) + " rows", "two rows or more");
  for (std::size_t i = 0; i < rows.size(); ++i)
    for (std::size_t j = 0; j < columns.size(); ++j) {
      double& value = rows[i].at(j);
      const double of_file = value;
      value /= columns[j].unit;
      if (!columns[j].limits.hold(value))
        throw refuse("row " + std::to_string(i + 1) + ": " + columns[j].name + " = " + shortest(of_file),
                     in_words(columns[j]));
    }
  return rows;
}

std::vector<std::pair<double, double>> read_rows(const Section& section, const TableReader& tables, const Column& x,
                                                 const Column& y) {
  std::vector<std::pair<double, double>> rows;
  for (const std::vector<double>& row : read_columns(section, tables, {x, y})) {
    const std::string place =
        "row " + std::to_string(rows.size() + 1) + ": " + x.name + " = " + shortest(row[0] * x.unit);
    const std::string increasing = x.name + " strictly increasing";
    if (!rows.empty() && !(row[0] > rows.back().first))
      throw section.refuse("file", place + " does not increase", increasing);
    if (!rows.empty() && !(row[0] - rows.back().first > 1e-90))  // the slope between two rows must be a number
      throw section.refuse("file", place + " is too close to the row before", increasing);
    rows.emplace_back(row[0], row[1]);
  }
  return rows;
}

}  // namespace slipfront::scenario
