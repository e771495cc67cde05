#pragma once
/// \file
/// Declarations of the numbers and arrays of a run on a plane. Files, tables, JSON, Python and the explorer are loops
/// over them.

#include <span>
#include <string_view>
#include <vector>

#include "slipfront/lattice/plane/run.hpp"
#include "slipfront/text/output/quantities.hpp"

namespace slipfront::plane {

extern const Description x_axis, y_axis, frequency_axis, moment_rate_spectrum;

/// Arrays over time, y and x.
std::span<const MemberArray<Field>> field_arrays();

/// Arrays over y and x.
std::span<const MemberArray<Maps>> map_arrays();
/// The description of a map of a run. It contains the rule by which cells rupture in this run, and must not outlive the
/// `schedule`.
Description description_of(const MemberArray<Maps>& map, const Schedule& schedule);

/// The points of all dislocation lines of all snapshots. After each line follows a point whose x and y are NaN.
struct LinePoints {
  std::vector<double> time, number, x, y;

  void add(double at, const Line& line, const Point& point);
};
LinePoints line_points(const std::vector<Field>& snapshots);

/// Arrays over the points of lines.
std::span<const MemberArray<LinePoints>> line_arrays();

/// A number over the times of the series. Where it has an error, its value at the end is also a number of the run.
struct SeriesNumber {
  Description about;
  double (*get)(const SeriesRow& row);
};
std::span<const SeriesNumber> series_numbers();

/// A run that has reached its end.
struct Report {
  const Run& run;
  Maps maps;
  std::vector<double> slip_at_probes, slip_velocity_at_probes;
  output::Spent spent;
};
/// The numbers of a run that its series does not have.
std::span<const output::Quantity<Report>> quantities();

}  // namespace slipfront::plane
