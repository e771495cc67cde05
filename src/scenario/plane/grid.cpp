#include "scenario/plane/grid.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

#include "foundation/text/digits.hpp"
#include "scenario/profile/monotone.hpp"
#include "scenario/profile/table.hpp"

namespace slipfront::scenario {
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

Grid grid_of(const Section& section, const std::vector<std::vector<double>>& rows) {
  std::vector<double> x, y;
  for (const std::vector<double>& row : rows) {
    x.push_back(row[0]);
    y.push_back(row[1]);
  }
  x = ascending(std::move(x));
  y = ascending(std::move(y));
  if (x.size() < 2 || y.size() < 2)
    throw section.refuse("file", std::to_string(x.size()) + " x and " + std::to_string(y.size()) + " y",
                         "at least two of each");
  std::vector<double> slip(x.size() * y.size(), std::numeric_limits<double>::quiet_NaN());
  for (const std::vector<double>& row : rows) {
    double& value = slip[index_of(y, row[1]) * x.size() + index_of(x, row[0])];
    if (!std::isnan(value))
      throw section.refuse("file", "x = " + shortest(row[0]) + ", y = " + shortest(row[1]) + " is given twice", "once");
    value = row[2];
  }
  Grid grid{.y = y, .along_x = {}};
  for (std::size_t j = 0; j < y.size(); ++j) {
    std::vector<std::pair<double, double>> points;
    for (std::size_t i = 0; i < x.size(); ++i) {
      if (std::isnan(slip[j * x.size() + i]))
        throw section.refuse("file", "x = " + shortest(x[i]) + ", y = " + shortest(y[j]) + " is missing",
                             "a row for each pair of an x and a y");
      points.emplace_back(x[i], slip[j * x.size() + i]);
    }
    grid.along_x.emplace_back(std::move(points));
  }
  return grid;
}

}  // namespace

std::function<double(double, double)> read_grid(const Section& section, const TableReader& tables, const Plane& plane) {
  const Limits place{.least = -farthest, .most = farthest};
  const double length = section.in_file(ModelUnit::position);
  const auto rows = read_columns(
      section, tables,
      {{"x", place, length}, {"y", place, length}, {"slip", {.least = 0}, section.in_file(ModelUnit::slip)}});
  const auto grid = std::make_shared<const Grid>(grid_of(section, rows));
  const plane::Problem& p = plane.problem;
  const double ratio = plane.wave_speed_ratio;
  const MonotoneCurve& row = grid->along_x.front();
  const auto range = [](double from, double to) { return shortest(from) + " to " + shortest(to); };
  if (!(row.first() <= p.left && row.last() >= p.right && grid->y.front() <= p.bottom * ratio &&
        grid->y.back() >= p.top * ratio))
    throw section.refuse(
        "file",
        "the grid has x = " + range(row.first(), row.last()) + ", y = " + range(grid->y.front(), grid->y.back()) +
            " and does not cover the plane",
        "a grid over x = " + range(p.left, p.right) + ", y = " + range(p.bottom * ratio, p.top * ratio));
  return [grid, ratio](double x, double y) { return (*grid)(x, y * ratio); };
}

}  // namespace slipfront::scenario
