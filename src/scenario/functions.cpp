#include "scenario/functions.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <memory>

#include "math/digits.hpp"

namespace slipfront::scenario {

InputError refused_at(Complaint where, std::string problem, std::string allowed) {
  where.problem = std::move(problem);
  where.allowed = std::move(allowed);
  return InputError(std::move(where));
}

Formula compiled(const Section& section, std::string_view key, const std::string& text,
                 const std::vector<std::string_view>& variables) {
  try {
    return {text, variables};
  } catch (const InputError& error) {
    throw section.refuse(key, error.complaint().problem, error.complaint().allowed);
  }
}

CheckedFormula::CheckedFormula(const Section& section, std::string_view key, const std::string& text,
                               std::vector<std::string_view> variables, std::string name, const Limits& limits,
                               ModelUnit unit, double ratio)
    : formula_(compiled(section, key, text, variables)),
      variables_(std::move(variables)),
      where_(section.where(key)),
      name_(std::move(name)),
      limits_(limits),
      length_(section.in_file(ModelUnit::position)),
      time_(formula_.has("t") ? section.in_file(ModelUnit::time) : 1),
      unit_(section.in_file(unit)),
      ratio_(ratio) {}

double CheckedFormula::operator()(double x, double y, double t) const {
  const double value = formula_(x * length_, y * ratio_ * length_, t * time_) / unit_;
  if (limits_.hold(value)) return value;
  std::string position;
  for (const std::string_view variable : variables_)
    position += (position.empty() ? " at " : ", ") + std::string(variable) + " = " +
                shortest(variable == "x"   ? x * length_
                         : variable == "y" ? y * ratio_ * length_
                                           : t * time_);
  throw refused_at(where_, name_ + " is " + shortest(value * unit_) + position, limits_.text());
}

CheckedFormula read_forcing(const Section& section, std::vector<std::string_view> variables, double ratio) {
  return {section,          "formula", *section.formula("formula"), std::move(variables), "the forcing", {},
          ModelUnit::force, ratio};
}

CheckedFormula read_contact(const Section& section, std::vector<std::string_view> variables, double ratio) {
  return {section,
          "contact",
          *section.formula("contact"),
          std::move(variables),
          "the contact ratio",
          {.least = 0, .without_least = true},
          ModelUnit::none,
          ratio};
}

namespace {

/// Slope at an inner point. It is 0 at an extremum, and otherwise the weighted harmonic mean of the chords before and
/// after (Fritsch & Butland 1984). This mean is in the region of Fritsch & Carlson (1980), where the cubic is monotone.
double inner_slope(double width, double next_width, double chord, double next_chord) {
  if (!(chord * next_chord > 0)) return 0;
  const double weight = 2 * next_width + width;
  const double next_weight = next_width + 2 * width;
  return (weight + next_weight) / (weight / chord + next_weight / next_chord);
}

/// Slope at an end: the slope of the parabola through three points, limited to the same region.
double end_slope(double width, double next_width, double chord, double next_chord) {
  const double slope = ((2 * width + next_width) * chord - width * next_chord) / (width + next_width);
  if (!(slope * chord > 0)) return 0;
  if (chord * next_chord <= 0 && std::fabs(slope) > 3 * std::fabs(chord)) return 3 * chord;
  return slope;
}

}  // namespace

MonotoneCurve::MonotoneCurve(std::vector<std::pair<double, double>> points) : points_(std::move(points)) {
  const std::size_t n = points_.size();
  std::vector<double> widths(n - 1);
  std::vector<double> chords(n - 1);
  for (std::size_t i = 0; i + 1 < n; ++i) {
    widths[i] = points_[i + 1].first - points_[i].first;
    chords[i] = (points_[i + 1].second - points_[i].second) / widths[i];
  }
  slopes_.assign(n, chords[0]);
  if (n == 2) return;
  slopes_.front() = end_slope(widths[0], widths[1], chords[0], chords[1]);
  slopes_.back() = end_slope(widths[n - 2], widths[n - 3], chords[n - 2], chords[n - 3]);
  for (std::size_t i = 1; i + 1 < n; ++i) slopes_[i] = inner_slope(widths[i - 1], widths[i], chords[i - 1], chords[i]);
}

double MonotoneCurve::operator()(double x) const {
  const auto after = std::upper_bound(points_.begin() + 1, points_.end() - 1, x,
                                      [](double value, const auto& point) { return value < point.first; });
  const std::size_t i = static_cast<std::size_t>(after - points_.begin()) - 1;
  const auto& [x0, y0] = points_[i];
  const auto& [x1, y1] = points_[i + 1];
  const double h = x1 - x0;
  const double s = (x - x0) / h;
  const double r = 1 - s;
  const double y =
      r * r * ((1 + 2 * s) * y0 + s * h * slopes_[i]) + s * s * ((1 + 2 * r) * y1 - r * h * slopes_[i + 1]);
  return std::clamp(y, std::min(y0, y1), std::max(y0, y1));  // rounding errors can leave the range
}

namespace {

std::string in_words(const Column& column) {
  return column.limits.text() +
         (column.unit == 1 ? "" : ", in the unit of the model, which is " + shortest(column.unit));
}

}  // namespace

std::vector<std::vector<double>> TableFile::columns(const std::vector<Column>& columns) const {
  // Relative to the scenario, wherever the program was started; an absolute path stays what it is.
  const std::string path = (std::filesystem::path(section.file()).parent_path() / name).string();
  if (name.empty() || path.find('\0') != std::string::npos) throw refuse("not a path", "a file");
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

std::vector<std::pair<double, double>> TableFile::rows(const Column& x, const Column& y) const {
  std::vector<std::pair<double, double>> rows;
  for (const std::vector<double>& row : columns({x, y})) {
    const std::string place =
        "row " + std::to_string(rows.size() + 1) + ": " + x.name + " = " + shortest(row[0] * x.unit);
    const std::string increasing = x.name + " strictly increasing";
    if (!rows.empty() && !(row[0] > rows.back().first)) throw refuse(place + " does not increase", increasing);
    if (!rows.empty() && !(row[0] - rows.back().first > 1e-90))  // the slope between two rows must be a number
      throw refuse(place + " is too close to the row before", increasing);
    rows.emplace_back(row[0], row[1]);
  }
  return rows;
}

namespace {

/// A curve along x for each y.
struct Grid {
  std::vector<double> y;
  std::vector<MonotoneCurve> along_x;

  /// The four rows around y, or fewer at the ends, give the curve along y.
  double operator()(double x, double at) const {
    const auto after = std::upper_bound(y.begin() + 1, y.end() - 1, at);
    const auto next = static_cast<std::size_t>(after - y.begin());
    const std::size_t first = next >= 2 ? next - 2 : 0, last = std::min(next + 2, y.size());
    std::vector<std::pair<double, double>> points;
    points.reserve(last - first);
    for (std::size_t j = first; j < last; ++j) points.emplace_back(y[j], along_x[j](x));
    return MonotoneCurve(std::move(points))(at);
  }
};

std::vector<double> ascending(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  values.erase(std::unique(values.begin(), values.end()), values.end());
  return values;
}

std::size_t index_of(const std::vector<double>& values, double value) {
  return static_cast<std::size_t>(std::lower_bound(values.begin(), values.end(), value) - values.begin());
}

Grid grid_of(const TableFile& file, const std::vector<std::vector<double>>& rows) {
  std::vector<double> x, y;
  for (const std::vector<double>& row : rows) {
    x.push_back(row[0]);
    y.push_back(row[1]);
  }
  x = ascending(std::move(x));
  y = ascending(std::move(y));
  if (x.size() < 2 || y.size() < 2)
    throw file.refuse(std::to_string(x.size()) + " x and " + std::to_string(y.size()) + " y", "at least two of each");
  std::vector<double> values(x.size() * y.size(), std::numeric_limits<double>::quiet_NaN());
  for (const std::vector<double>& row : rows) {
    double& value = values[index_of(y, row[1]) * x.size() + index_of(x, row[0])];
    if (!std::isnan(value))
      throw file.refuse("x = " + shortest(row[0]) + ", y = " + shortest(row[1]) + " is given twice", "once");
    value = row[2];
  }
  Grid grid{.y = y, .along_x = {}};
  for (std::size_t j = 0; j < y.size(); ++j) {
    std::vector<std::pair<double, double>> points;
    for (std::size_t i = 0; i < x.size(); ++i) {
      if (std::isnan(values[j * x.size() + i]))
        throw file.refuse("x = " + shortest(x[i]) + ", y = " + shortest(y[j]) + " is missing",
                          "a row for each pair of an x and a y");
      points.emplace_back(x[i], values[j * x.size() + i]);
    }
    grid.along_x.emplace_back(std::move(points));
  }
  return grid;
}

}  // namespace

std::function<double(double, double)> read_grid(const TableFile& file, const Column& value, const Extent& extent) {
  const Limits place{.least = -farthest, .most = farthest};
  const double length = file.section.in_file(ModelUnit::position);
  const auto rows = file.columns({{"x", place, length}, {"y", place, length}, value});
  const auto grid = std::make_shared<const Grid>(grid_of(file, rows));
  const MonotoneCurve& row = grid->along_x.front();
  const auto range = [](double from, double to) { return shortest(from) + " to " + shortest(to); };
  if (!(row.first() <= extent.left && row.last() >= extent.right && grid->y.front() <= extent.bottom &&
        grid->y.back() >= extent.top))
    throw file.refuse(
        "the grid has x = " + range(row.first(), row.last()) + ", y = " + range(grid->y.front(), grid->y.back()) +
            " and does not cover the plane",
        "a grid over x = " + range(extent.left, extent.right) + ", y = " + range(extent.bottom, extent.top));
  return [grid](double x, double y) { return (*grid)(x, y); };
}

}  // namespace slipfront::scenario
