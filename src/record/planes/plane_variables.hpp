#pragma once
/// \file
/// The variables of the file of a run on a plane, one line each.

#include <span>
#include <string_view>
#include <vector>

#include "slipfront/description.hpp"
#include "slipfront/plane/run.hpp"

namespace slipfront::record {

extern const Description plane_time, plane_x, plane_y, plane_frequency, plane_spectrum;

/// A variable over time, y and x.
struct PlaneField {
  Description about;
  std::vector<double> plane::Field::*values;
};
/// A variable over y and x.
struct PlaneMap {
  Description about;
  std::vector<double> plane::Maps::*values;
};
/// A variable over the times of the series.
struct PlaneSeries {
  Description about;
  double (*get)(const plane::SeriesRow& row);
};

/// The points of all dislocation lines of all snapshots. After each line follows a point whose x and y are NaN.
struct LinePoints {
  std::vector<double> time, number, x, y;

  void add(double at, const plane::Line& line, const plane::Point& point);
};
LinePoints line_points(const std::vector<plane::Field>& snapshots);

/// A variable over the points of lines.
struct PlaneLine {
  Description about;
  std::vector<double> LinePoints::*values;
};

std::span<const PlaneLine> plane_lines();
std::span<const PlaneField> plane_fields();
std::span<const PlaneMap> plane_maps();
/// The description of a map of a run. It contains the rule by which cells rupture in this run, and must not outlive the
/// `schedule`.
Description description_of(const PlaneMap& map, const plane::Schedule& schedule);
std::span<const PlaneSeries> plane_series();

/// The unit of a variable of the model, such as "b / A"; empty for another name.
std::string_view plane_unit(std::string_view name);

}  // namespace slipfront::record
