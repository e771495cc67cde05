#include <cstddef>
#include <memory>

#include "record/runs/arrays.hpp"
#include "slipfront/plane/quantities.hpp"
#include "slipfront/plane/source_parameters.hpp"

namespace slipfront::record {
namespace {

/// Centres of the cells between two ends.
std::vector<double> centres(double from, double to, int cells) {
  std::vector<double> all;
  all.reserve(static_cast<std::size_t>(cells));
  for (int i = 0; i < cells; ++i) all.push_back(from + (to - from) * (i + 0.5) / cells);
  return all;
}

}  // namespace

std::vector<Array> arrays_of(const plane::Run& run) {
  std::vector<Array> all;
  const plane::Problem& p = run.solver().problem();
  const plane::Schedule& schedule = run.schedule();
  const double ratio = schedule.wave_speed_ratio;
  const std::vector<plane::Field>& snapshots = run.snapshots();
  all.push_back(coordinate(output::time_axis, values_of(snapshots, &plane::Field::time)()));
  all.push_back(coordinate(plane::y_axis, centres(ratio * p.bottom, ratio * p.top, schedule.ny), "Y"));
  all.push_back(coordinate(plane::x_axis, centres(p.left, p.right, schedule.nx), "X"));
  const std::vector<Array::Dimension> cells = {all[1].dimensions.front(), all[2].dimensions.front()};
  for (const MemberArray<plane::Field>& field : plane::field_arrays())
    all.push_back(
        {field.about, {all[0].dimensions.front(), cells[0], cells[1]}, values_of(snapshots, field.values), {}});
  const auto maps = std::make_shared<const plane::Maps>(run.maps());
  for (const MemberArray<plane::Maps>& map : plane::map_arrays())
    all.push_back({description_of(map, schedule), cells, [maps, member = map.values] { return *maps.*member; }, {}});
  for (const plane::SeriesNumber& number : plane::series_numbers())
    all.push_back({number.about,
                   {{plane::series_numbers().front().about.name, run.series().size()}},
                   values_of(run.series(), number.get),
                   {}});
  const std::vector<double> frequencies = plane::spectrum_frequencies(run.series());
  all.push_back(coordinate(plane::frequency_axis, frequencies));
  all.push_back({plane::moment_rate_spectrum,
                 all.back().dimensions,
                 [&run, frequencies] { return plane::spectrum(run.series(), frequencies); },
                 {}});
  if (!schedule.lines) return all;
  const auto lines = std::make_shared<const plane::LinePoints>(plane::line_points(snapshots));
  for (const MemberArray<plane::LinePoints>& line : plane::line_arrays())
    all.push_back(
        {line.about, {{"line_point", lines->x.size()}}, [lines, member = line.values] { return *lines.*member; }, {}});
  return all;
}

}  // namespace slipfront::record
