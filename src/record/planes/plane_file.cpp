#include "record/planes/plane_file.hpp"

#include <cmath>
#include <cstddef>
#include <memory>
#include <utility>

#include "foundation/math/constants.hpp"
#include "record/netcdf/netcdf.hpp"
#include "record/pulses/arrays.hpp"
#include "record/pulses/cf.hpp"
#include "slipfront/plane/quantities.hpp"
#include "slipfront/plane/source_parameters.hpp"

namespace slipfront::record {
namespace {

using netcdf::Writer;

/// Centres of the cells between two ends.
std::vector<double> centres(double from, double to, int cells) {
  std::vector<double> all;
  all.reserve(static_cast<std::size_t>(cells));
  for (int i = 0; i < cells; ++i) all.push_back(from + (to - from) * (i + 0.5) / cells);
  return all;
}

int opaque(Writer& file, const char* name, const char* long_name, std::size_t size) {
  const int variable = file.bytes(name, {file.dimension(std::string(name) + "_bytes", size)});
  file.attribute(variable, "long_name", long_name);
  file.attribute(variable, "units", "1");
  return variable;
}

void add_series(std::vector<Array>& all, const plane::Run& run) {
  for (const plane::SeriesNumber& number : plane::series_numbers())
    all.push_back({number.about,
                   {{plane::series_numbers().front().about.name, run.series().size()}},
                   [&run, get = number.get] {
                     std::vector<double> values;
                     values.reserve(run.series().size());
                     for (const plane::SeriesRow& row : run.series()) values.push_back(get(row));
                     return values;
                   },
                   {}});
}

}  // namespace

std::vector<Array> arrays_of(const plane::Run& run) {
  std::vector<Array> all;
  const plane::Problem& p = run.solver().problem();
  const plane::Schedule& schedule = run.schedule();
  const double ratio = schedule.wave_speed_ratio;
  const std::vector<plane::Field>& snapshots = run.snapshots();
  std::vector<double> times;
  times.reserve(snapshots.size());
  for (const plane::Field& snapshot : snapshots) times.push_back(snapshot.time);
  all.push_back(coordinate(output::time_axis, times));
  all.push_back(coordinate(plane::y_axis, centres(ratio * p.bottom, ratio * p.top, schedule.ny), "Y"));
  all.push_back(coordinate(plane::x_axis, centres(p.left, p.right, schedule.nx), "X"));
  const std::vector<Array::Dimension> cells = {all[1].dimensions.front(), all[2].dimensions.front()};
  for (const MemberArray<plane::Field>& field : plane::field_arrays())
    all.push_back({field.about,
                   {all[0].dimensions.front(), cells[0], cells[1]},
                   [&snapshots, member = field.values] {
                     std::vector<double> values;
                     for (const plane::Field& snapshot : snapshots)
                       values.insert(values.end(), (snapshot.*member).begin(), (snapshot.*member).end());
                     return values;
                   },
                   {}});
  const auto maps = std::make_shared<const plane::Maps>(run.maps());
  for (const MemberArray<plane::Maps>& map : plane::map_arrays())
    all.push_back({description_of(map, schedule), cells, [maps, member = map.values] { return *maps.*member; }, {}});
  add_series(all, run);
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

void write_plane(const std::string& path, const PulseMetadata& metadata, const plane::Run& run,
                 const std::string& state) {
  const std::size_t cells = static_cast<std::size_t>(run.schedule().nx) * static_cast<std::size_t>(run.schedule().ny);
  std::size_t values = cells * (plane::field_arrays().size() * run.snapshots().size() + 2 * plane::map_arrays().size());
  for (const plane::Field& snapshot : run.snapshots())
    for (const plane::Line& line : snapshot.lines) values += 4 * (line.points.size() + 1);
  write_netcdf(path, values * sizeof(double) + (1 << 16), [&](Writer& file) {
    cf::describe_file(file, metadata, plane_format, run.finished());
    const std::vector<Array> arrays = arrays_of(run);
    const Defined defined = define(file, arrays, metadata);
    const int checkpoint = opaque(file, "checkpoint", "state of the run, to resume it", state.size());
    const int scenario = opaque(file, "scenario_text", "the scenario, byte by byte", metadata.scenario_text.size());
    file.end_definitions();
    write(file, defined, arrays);
    file.write(checkpoint, state);
    file.write(scenario, metadata.scenario_text);
  });
}

}  // namespace slipfront::record
