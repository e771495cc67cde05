#include "record/runs/arrays.hpp"

#include <memory>
#include <numeric>
#include <string>
#include <utility>

#include "foundation/machine.hpp"
#include "foundation/math/constants.hpp"
#include "foundation/text/digits.hpp"
#include "record/runs/cf.hpp"
#include "record/runs/run_layout.hpp"
#include "record/runs/run_variables.hpp"
#include "slipfront/error.hpp"
#include "slipfront/output/dislocation_paths.hpp"
#include "slipfront/output/quantities.hpp"

namespace slipfront::record {
namespace {

using Dimensions = std::vector<Array::Dimension>;
using output::Snapshot;

/// The values of every snapshot, level by level. `put` appends those of one.
template <class Put>
std::vector<double> over_snapshots(const Levels& levels, const Put& put) {
  std::vector<double> values;
  for (const std::vector<Snapshot>* level : levels)
    for (const Snapshot& snapshot : *level) put(values, snapshot, level->front());
  return values;
}

void add_axes(std::vector<Array>& all, const std::vector<double>& times, const std::vector<double>& edges) {
  std::vector<double> centres, bounds;
  for (std::size_t i = 0; i + 1 < edges.size(); ++i) {
    centres.push_back(std::midpoint(edges[i], edges[i + 1]));
    bounds.insert(bounds.end(), {edges[i], edges[i + 1]});
  }
  const std::size_t cells = centres.size();
  all.push_back(coordinate(output::time_axis, times));
  all.push_back(
      coordinate({"x", "position along the interface, centre of the cell", "b / A", "Eq. 3"}, std::move(centres), "X"));
  const Description about = {"x_bounds", "ends of the cell", "b / A", "Eq. 3"};
  all.back().attributes.emplace_back("bounds", about.name);
  all.push_back({about, {{"x", cells}, {"ends", 2}}, [bounds] { return bounds; }, {}});
}

/// The slip events, and their arrivals at the positions that the scenario asks for.
void add_events(std::vector<Array>& all, const RunMetadata& metadata) {
  const std::vector<output::SlipEvent>& events = metadata.events;
  if (events.empty()) return;
  for (const output::SlipEventColumn& column : output::slip_event_columns())
    all.push_back({output::description_of(column, metadata.pulled_end),
                   {{"event", events.size()}},
                   values_of(events, column.value),
                   {}});
  const output::FrontRecords& fronts = metadata.fronts;
  if (fronts.events.empty()) return;
  all.push_back(coordinate(output::front_position, fronts.x));
  for (const MemberArray<output::FrontRecord>& column : output::front_columns())
    all.push_back({column.about,
                   {{"event", events.size()}, {output::front_position.name, fronts.x.size()}},
                   values_of(fronts.events, column.values),
                   {}});
}

void add_displacement(std::vector<Array>& all, const RunMetadata& metadata, const std::vector<Snapshot>& snapshots) {
  if (metadata.sites.empty()) return;
  all.push_back(coordinate(layout::site, metadata.sites));
  all.push_back({layout::displacement,
                 {{"time", snapshots.size()}, {layout::site.name, metadata.sites.size()}},
                 values_of(snapshots, &Snapshot::displacement),
                 {}});
}

/// \throws NumericsError if the table of all dislocations at all times is too large.
void require_memory(const output::DislocationPaths& paths) {
  const double bytes = 2 * sizeof(double) * static_cast<double>(paths.signs.size() * paths.numbers.size());
  if (bytes > usable_memory() / 4)
    throw NumericsError("the paths of " + std::to_string(paths.signs.size()) + " dislocations at " +
                        std::to_string(paths.numbers.size()) + " times need " + digits(bytes / 1e9, 3) +
                        " GB; fewer outputs are needed");
}

void add_dislocations(std::vector<Array>& all, const RunMetadata& metadata, const std::vector<Snapshot>& snapshots) {
  const auto paths =
      std::make_shared<const output::DislocationPaths>(output::dislocation_paths(snapshots, metadata.paths));
  const std::size_t count = paths->signs.size();
  if (count == 0) return;
  require_memory(*paths);
  std::vector<double> numbers(count);
  std::iota(numbers.begin(), numbers.end(), 1.0);
  all.push_back(coordinate(layout::dislocation, std::move(numbers)));
  const Array::Dimension dislocation{layout::dislocation.name, count};
  all.push_back({layout::dislocation_sign,
                 {dislocation},
                 [paths] { return std::vector<double>(paths->signs.begin(), paths->signs.end()); },
                 {}});
  const auto add = [&](const Description& about, double (*get)(const output::Dislocation&)) {
    all.push_back({about,
                   {{"time", snapshots.size()}, dislocation},
                   [&snapshots, paths, count, get] {
                     std::vector<double> values(snapshots.size() * count, none);
                     for (std::size_t i = 0; i < snapshots.size(); ++i)
                       for (std::size_t j = 0; j < snapshots[i].dislocations.size(); ++j)
                         values[i * count + paths->numbers[i][j]] = get(snapshots[i].dislocations[j]);
                     return values;
                   },
                   {}});
  };
  add(layout::dislocation_position, [](const output::Dislocation& d) { return d.x; });
  add(layout::dislocation_level, [](const output::Dislocation& d) { return static_cast<double>(d.level); });
}

}  // namespace

Array coordinate(const Description& about, std::vector<double> values, std::string_view axis) {
  Array array{about, {{about.name, values.size()}}, {}, {}};
  array.values = [kept = std::move(values)] { return kept; };
  if (!axis.empty()) array.attributes.emplace_back("axis", axis);
  return array;
}

std::vector<Array> arrays_of(const RunMetadata& metadata, const std::vector<Snapshot>& snapshots) {
  return arrays_of(metadata, values_of(snapshots, &Snapshot::time)(), {&snapshots}, false);
}

std::vector<Array> arrays_of(const RunMetadata& metadata, const std::vector<double>& times, const Levels& levels,
                             bool by_level) {
  std::vector<Array> all;
  add_axes(all, times, metadata.x_edges);
  Dimensions over_time;
  if (by_level) over_time.push_back({"level", levels.size()});
  over_time.push_back({"time", times.size()});
  Dimensions over_x = over_time;
  over_x.push_back({"x", metadata.x_edges.size() - 1});
  for (const FieldVariable* field : chosen_fields(metadata.variables))
    all.push_back({field->about,
                   over_x,
                   [levels, field] {
                     return over_snapshots(levels, [&](auto& values, const Snapshot& s, const Snapshot& first) {
                       const std::vector<double> row = field->of(s, first);
                       values.insert(values.end(), row.begin(), row.end());
                     });
                   },
                   {}});
  for (const output::Scalar& scalar : output::scalars())
    all.push_back({scalar.about,
                   over_time,
                   [levels, get = scalar.get] {
                     return over_snapshots(
                         levels, [&](auto& values, const Snapshot& s, const Snapshot&) { values.push_back(get(s)); });
                   },
                   {}});
  add_events(all, metadata);
  if (by_level) return all;
  add_displacement(all, metadata, *levels.front());
  add_dislocations(all, metadata, *levels.front());
  return all;
}

Defined define(netcdf::Writer& file, const std::vector<Array>& arrays, const RunMetadata& metadata) {
  Defined defined;
  for (const Array& array : arrays) {
    std::vector<int> ids;
    for (const Array::Dimension& dimension : array.dimensions) {
      const auto [found, is_new] = defined.dimensions.try_emplace(dimension.name, 0);
      if (is_new) found->second = file.dimension(std::string(dimension.name), dimension.size);
      ids.push_back(found->second);
    }
    const int variable = cf::reals(file, array.about, ids, metadata);
    for (const auto& [name, value] : array.attributes) file.attribute(variable, std::string(name), value);
    if (!array.about.reason.empty()) file.fill_value(variable, none);
    defined.variables.push_back(variable);
  }
  return defined;
}

void write(netcdf::Writer& file, const Defined& defined, const std::vector<Array>& arrays) {
  for (std::size_t i = 0; i < arrays.size(); ++i)
    if (const std::vector<double> values = arrays[i].values(); !values.empty())
      file.write_all(defined.variables[i], values);
}

}  // namespace slipfront::record
