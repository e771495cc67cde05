#include "runs/record/arrays.hpp"

#include <algorithm>
#include <cstddef>
#include <memory>
#include <numeric>
#include <string>
#include <string_view>
#include <utility>

#include "math/constants.hpp"
#include "math/digits.hpp"
#include "runs/record/run_file.hpp"
#include "slipfront/error.hpp"
#include "slipfront/lattice/plane/quantities.hpp"
#include "slipfront/lattice/plane/source_parameters.hpp"
#include "slipfront/text/output/dislocation_paths.hpp"
#include "slipfront/text/output/quantities.hpp"
#include "system/machine.hpp"

namespace slipfront::record {
namespace {

constexpr std::string_view paper = "Gershenzon, Bambakidis and Skinner (2015)";
constexpr std::string_view paper_title =
    "How does dissipation affect the transition from static to dynamic macroscopic friction?";

std::string comment_of(const RunMetadata& metadata) {
  if (!metadata.units)
    return "All values are dimensionless. Multiply them by dimensional_unit, where A is the contact ratio, b the "
           "asperity spacing, c the speed of strain waves, mu the shear modulus and nu the Poisson ratio.";
  return "All values are in SI units, by the constants in the attribute medium. A file stores them in the unit of the "
         "model, with a scale_factor (CF, section 8.1) that readers of NetCDF apply.";
}

}  // namespace

std::string long_name_of(const Description& about, const medium::UnitInSi& unit) {
  return std::string(about.long_name) + (unit.between_faces ? ", between the faces" : "");
}

Attributes attributes_of(const Description& about, const RunMetadata& metadata) {
  const std::string unit_of_model(about.dimensional_unit), reference = reference_of(about);
  if (!metadata.units || unit_of_model.empty())
    return {{"long_name", std::string(about.long_name)},
            {"units", "1"},
            {"dimensional_unit", unit_of_model},
            {"references", reference}};
  const medium::UnitInSi unit = metadata.units->of(unit_of_model);
  return {{"long_name", long_name_of(about, unit)},
          {"units", std::string(unit.name)},
          {"scale_factor", unit.value},
          {"unit_of_model", unit_of_model},
          {"references", reference}};
}

std::string reference_of(const Description& about) { return std::string(paper) + ", " + std::string(about.reference); }

std::vector<std::pair<std::string, std::string>> file_attributes(const RunMetadata& metadata) {
  std::string warnings;
  for (const std::string& warning : metadata.warnings) warnings += (warnings.empty() ? "" : "\n") + warning;
  std::vector<std::pair<std::string, std::string>> all = {
      {"Conventions", "CF-1.10"},
      {"title", metadata.title},
      {"source", "slipfront " + metadata.version},
      {"history", metadata.command_line},
      {"references", std::string(paper) + ", " + std::string(paper_title)},
      {"comment", comment_of(metadata)},
      {"version", metadata.version},
      {"warnings", warnings},
      {"scenario", metadata.scenario_text},
      {"slipfront_format", metadata.format},
  };
  if (metadata.units) {
    all.emplace_back("unit_system", "SI");
    all.emplace_back("medium", metadata.units->in_words());
  }
  return all;
}

namespace {

using Dimensions = std::vector<Array::Dimension>;
using output::Snapshot;

using Series = std::vector<const std::vector<Snapshot>*>;  ///< the snapshots of one run, or of each level

/// The values of every snapshot, level by level. `put` appends those of one.
template <class Put>
std::vector<double> over_snapshots(const Series& series, const Put& put) {
  std::vector<double> values;
  for (const std::vector<Snapshot>* level : series)
    for (const Snapshot& snapshot : *level) put(values, snapshot, level->front());
  return values;
}

/// The axes, the fields over x, and the numbers over time. `over` are the dimensions before time.
std::vector<Array> arrays_over(Dimensions over, const std::vector<double>& times, const std::vector<double>& edges,
                               const std::vector<std::string>& variables, const Series& series) {
  std::vector<Array> all;
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
  over.push_back({"time", times.size()});
  Dimensions over_x = over;
  over_x.push_back({"x", cells});
  for (const FieldVariable* field : chosen_fields(variables))
    all.push_back({field->about,
                   over_x,
                   [series, field] {
                     return over_snapshots(series, [&](auto& values, const Snapshot& s, const Snapshot& first) {
                       const std::vector<double> row = field->of(s, first);
                       values.insert(values.end(), row.begin(), row.end());
                     });
                   },
                   {}});
  for (const output::Scalar& scalar : output::scalars())
    all.push_back({scalar.about,
                   over,
                   [series, get = scalar.get] {
                     return over_snapshots(
                         series, [&](auto& values, const Snapshot& s, const Snapshot&) { values.push_back(get(s)); });
                   },
                   {}});
  return all;
}

/// The slip events, and their arrivals at the positions that the scenario asks for.
void add_events(std::vector<Array>& all, const chain::Run& run) {
  const std::vector<output::SlipEvent> events = run.events();
  const output::FrontRecords fronts = run.fronts();
  if (events.empty()) return;
  const bool pulled_end = run.chain().problem().loading.where != chain::Pulled::everywhere;
  const auto add = [&](const Description& about, const Dimensions& dimensions, std::vector<double> values) {
    all.push_back({about, dimensions, [kept = std::move(values)] { return kept; }, {}});
  };
  for (const output::SlipEventColumn& column : output::slip_event_columns())
    add(output::description_of(column, pulled_end), {{"event", events.size()}}, values_of(events, column.value)());
  if (fronts.events.empty()) return;
  all.push_back(coordinate(output::front_position, fronts.x));
  for (const MemberArray<output::FrontRecord>& column : output::front_columns())
    add(column.about, {{"event", events.size()}, {output::front_position.name, fronts.x.size()}},
        values_of(fronts.events, column.values)());
}

/// \throws NumericsError if the table of all dislocations at all times is too large.
void require_memory(const output::DislocationPaths& paths) {
  const double bytes = 2 * sizeof(double) * static_cast<double>(paths.signs.size() * paths.numbers.size());
  if (bytes > usable_memory() / 4)
    throw NumericsError("the paths of " + std::to_string(paths.signs.size()) + " dislocations at " +
                        std::to_string(paths.numbers.size()) + " times need " + digits(bytes / 1e9, 3) +
                        " GB; fewer outputs are needed");
}

}  // namespace

void add_displacement(std::vector<Array>& all, const std::vector<double>& sites,
                      const std::vector<Snapshot>& snapshots) {
  all.push_back(coordinate(layout::site, sites));
  all.push_back({layout::displacement,
                 {{"time", snapshots.size()}, {layout::site.name, sites.size()}},
                 values_of(snapshots, &Snapshot::displacement),
                 {}});
}

void add_dislocations(std::vector<Array>& all, const output::PathSettings& settings,
                      const std::vector<Snapshot>& snapshots) {
  const auto paths = std::make_shared<const output::DislocationPaths>(output::dislocation_paths(snapshots, settings));
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

Array coordinate(const Description& about, std::vector<double> values, std::string_view axis) {
  Array array{about, {{about.name, values.size()}}, {}, {}};
  array.values = [kept = std::move(values)] { return kept; };
  if (!axis.empty()) array.attributes.emplace_back("axis", axis);
  return array;
}

std::vector<Array> arrays_of(const std::vector<double>& x_edges, const std::vector<std::string>& variables,
                             const std::vector<Snapshot>& snapshots) {
  return arrays_over({}, values_of(snapshots, &Snapshot::time)(), x_edges, variables, {&snapshots});
}

std::vector<Array> arrays_of(const pulse::Run& run, const std::vector<std::string>& variables) {
  return arrays_of(run.schedule().x_edges, variables, run.snapshots());
}

std::vector<Array> arrays_of(const chain::Run& run, const std::vector<std::string>& variables) {
  std::vector<Array> all = arrays_of(run.schedule().x_edges, variables, run.snapshots());
  add_events(all, run);
  if (run.schedule().displacement) add_displacement(all, run.sites(), run.snapshots());
  if (run.schedule().dislocations) add_dislocations(all, run.path_settings(), run.snapshots());
  return all;
}

std::vector<Array> arrays_of(const output::Schedule& schedule, const std::vector<std::string>& variables,
                             const std::vector<Level>& levels) {
  Series series;
  std::vector<double> scales;
  for (const Level& level : levels) {
    series.push_back(level.snapshots);
    scales.push_back(level.scale);
  }
  const Dimensions by_level = {{"level", levels.size()}};
  std::vector<Array> all = arrays_over(by_level, schedule.times, schedule.x_edges, variables, series);
  all.push_back({output::scale_factor, by_level, [scales] { return scales; }, {}});
  return all;
}

Dataset dataset_of(const std::vector<Array>& arrays, const RunMetadata& metadata, bool finished) {
  Dataset file;
  for (const auto& [name, value] : file_attributes(metadata))
    file.attributes.emplace_back(name, clean_text(value, netcdf::longest_text));
  file.attributes.emplace_back("finished", finished ? 1 : 0);
  for (const Array& array : arrays) {
    DatasetVariable variable{std::string(array.about.name), {}, array.values, attributes_of(array.about, metadata)};
    for (const Array::Dimension& dimension : array.dimensions) {
      variable.dimensions.emplace_back(dimension.name);
      const auto is_it = [&](const auto& known) { return known.first == dimension.name; };
      if (std::none_of(file.dimensions.begin(), file.dimensions.end(), is_it))
        file.dimensions.emplace_back(dimension.name, dimension.size);
    }
    for (const auto& [name, value] : array.attributes)
      variable.attributes.emplace_back(std::string(name), std::string(value));
    if (!array.about.reason.empty()) variable.attributes.emplace_back("_FillValue", none);
    file.variables.push_back(std::move(variable));
  }
  return file;
}

namespace {

/// Centres of the cells between two ends.
std::vector<double> centres(double from, double to, int cells) {
  std::vector<double> all;
  all.reserve(static_cast<std::size_t>(cells));
  for (int i = 0; i < cells; ++i) all.push_back(from + (to - from) * (i + 0.5) / cells);
  return all;
}

}  // namespace

std::vector<Array> arrays_of(const plane::Run& run, const std::vector<std::string>& /*variables*/) {
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
