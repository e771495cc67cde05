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

std::vector<std::pair<double, double>> read_rows(const Section& section, const TableReader& tables, const Column& x,
                                                 const Column& y) {
  const auto refuse = [&](const std::string& problem, const std::string& allowed) {
    return section.refuse("file", problem, allowed);
  };
  const std::string file = *section.text("file");
  // Relative to the scenario, wherever the program was started; an absolute path stays what it is.
  const std::string path = (std::filesystem::path(section.file()).parent_path() / file).string();
  if (file.empty() || path.find('\0') != std::string::npos) throw refuse("not a path", "a file");
  if (!tables) throw refuse("a table cannot be read here", "a formula");
  std::vector<std::pair<double, double>> rows = tables(path, x.name, y.name);
  if (rows.size() < 2) throw refuse("a table of " + std::to_string(rows.size()) + " rows", "two rows or more");
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const auto [x_of_file, y_of_file] = rows[i];
    const double at = x_of_file / x.unit, value = y_of_file / y.unit;
    rows[i] = {at, value};
    const std::string row = "row " + std::to_string(i + 1) + ": ", place = row + x.name + " = " + shortest(x_of_file);
    const std::string increasing = x.name + " strictly increasing";
    if (!x.limits.hold(at)) throw refuse(place, in_words(x));
    if (!y.limits.hold(value)) throw refuse(row + y.name + " = " + shortest(y_of_file), in_words(y));
    if (i > 0 && !(at > rows[i - 1].first)) throw refuse(place + " does not increase", increasing);
    if (i > 0 && !(at - rows[i - 1].first > 1e-90))  // the slope between two rows must be a number
      throw refuse(place + " is too close to the row before", increasing);
  }
  return rows;
}

}  // namespace slipfront::scenario
