#include "record/pulses/pulse_file.hpp"

#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>
#include <stdexcept>

#include "record/netcdf/netcdf.hpp"
#include "record/pulses/cf.hpp"
#include "record/pulses/pulse_layout.hpp"
#include "record/pulses/pulse_variables.hpp"

namespace slipfront::record {
namespace {

using netcdf::Writer;
using output::Snapshot;
using Fields = std::vector<const FieldVariable*>;

void require(bool truth, const char* what) {
  if (!truth) throw std::invalid_argument(std::string("write_pulse: ") + what);
}

void check(const PulseMetadata& metadata, const std::vector<Snapshot>& snapshots, const Fields& fields) {
  const auto& edges = metadata.x_edges;
  require(edges.size() >= 2, "x_edges has no cell");
  for (std::size_t i = 0; i < edges.size(); ++i)
    require(std::isfinite(edges[i]) && (i == 0 || edges[i - 1] < edges[i]), "x_edges is not ascending");
  for (std::size_t i = 0; i < snapshots.size(); ++i) {
    require(std::isfinite(snapshots[i].time) && (i == 0 || snapshots[i - 1].time < snapshots[i].time),
            "times do not ascend");
    for (const FieldVariable* field : fields)
      require((snapshots[i].profile.*field->values).size() + 1 == edges.size(), "a profile has not as many cells as x");
  }
}

/// Bytes that mean nothing to anyone else.
int opaque(Writer& file, const std::string& name, const std::string& long_name, std::size_t size) {
  const int variable = file.bytes(name, {file.dimension(name + "_bytes", size)});
  file.attribute(variable, "long_name", long_name);
  file.attribute(variable, "units", "1");
  file.attribute(variable, "references", "slipfront, src/record");
  return variable;
}

/// Attributes of the file. Returns whether they hold the scenario exactly.
bool describe_file(Writer& file, const PulseMetadata& metadata, bool finished) {
  cf::describe_file(file, metadata, pulse_format, finished);
  return clean_text(metadata.scenario_text, netcdf::longest_text) == metadata.scenario_text;
}

void write_field(Writer& file, int variable, const FieldVariable& field, const std::vector<Snapshot>& snapshots) {
  for (std::size_t row = 0; row < snapshots.size(); ++row)
    file.write_row(variable, row, field.of(snapshots[row], snapshots.front()));
}

void write_scalar(Writer& file, int variable, const output::Scalar& scalar, const std::vector<Snapshot>& snapshots) {
  std::vector<double> values;
  values.reserve(snapshots.size());
  for (const Snapshot& snapshot : snapshots) values.push_back(scalar.get(snapshot));
  file.write(variable, values);
}

/// The dimension and the variables of the slip events.
struct Events {
  int dimension = -1;
  std::vector<int> variables;
};

/// Variables of the slip events, named event_onset and so on; none where there are no events.
Events define_events(Writer& file, const PulseMetadata& metadata) {
  Events events;
  if (metadata.events.empty()) return events;
  events.dimension = file.dimension("event", metadata.events.size());
  for (const output::SlipEventColumn& column : output::slip_event_columns()) {
    const std::string name = "event_" + std::string(column.about.name);
    Description about = output::description_of(column, metadata.pulled_end);
    about.name = name;
    events.variables.push_back(cf::reals(file, about, {events.dimension}, metadata));
  }
  return events;
}

void write_events(Writer& file, const std::vector<int>& ids, const PulseMetadata& metadata) {
  for (std::size_t i = 0; i < ids.size(); ++i) {
    std::vector<double> values;
    for (const output::SlipEvent& event : metadata.events)
      values.push_back(event.*output::slip_event_columns()[i].value);
    file.write(ids[i], values);
  }
}

/// Variables of the arrivals of slip events, first the positions; none where no arrivals are recorded.
std::vector<int> define_fronts(Writer& file, const PulseMetadata& metadata, int event) {
  std::vector<int> ids;
  if (metadata.fronts.events.empty()) return ids;
  const int position = file.dimension("position", metadata.fronts.x.size());
  ids.push_back(cf::reals(file, output::front_position, {position}, metadata));
  for (const output::FrontColumn& column : output::front_columns())
    ids.push_back(cf::reals(file, column.about, {event, position}, metadata));
  file.fill_value(ids[1], std::numeric_limits<double>::quiet_NaN());
  return ids;
}

void write_fronts(Writer& file, const std::vector<int>& ids, const output::FrontRecords& fronts) {
  if (ids.empty()) return;
  file.write(ids[0], fronts.x);
  for (std::size_t i = 1; i < ids.size(); ++i)
    for (std::size_t row = 0; row < fronts.events.size(); ++row)
      file.write_row(ids[i], row, fronts.events[row].*output::front_columns()[i - 1].values);
}

/// All of the file.
void fill(Writer& file, const PulseMetadata& metadata, const std::vector<Snapshot>& snapshots,
          const std::string& solver_state, bool finished, const Fields& fields) {
  const std::size_t cells = metadata.x_edges.size() - 1;
  const bool scenario_in_attribute = describe_file(file, metadata, finished);
  file.attribute(Writer::global, "checksum",
                 layout::checksum(metadata.scenario_text, solver_state, finished, snapshots, fields));
  const cf::Axes axes = cf::axes(file, snapshots.size(), cells, metadata);
  std::vector<int> field_ids, scalar_ids;
  for (const FieldVariable* field : fields)
    field_ids.push_back(cf::reals(file, field->about, {axes.time, axes.x}, metadata));
  for (const output::Scalar& scalar : output::scalars()) {
    scalar_ids.push_back(cf::reals(file, scalar.about, {axes.time}, metadata));
    if (!scalar.about.reason.empty()) file.fill_value(scalar_ids.back(), std::numeric_limits<double>::quiet_NaN());
  }
  const Events events = define_events(file, metadata);
  const std::vector<int> front_ids = define_fronts(file, metadata, events.dimension);
  const int state = opaque(file, layout::solver_state, "state of the solver, to resume the run", solver_state.size());
  const int scenario = scenario_in_attribute ? -1
                                             : opaque(file, layout::scenario_bytes, "the scenario, byte by byte",
                                                      metadata.scenario_text.size());

  file.end_definitions();
  std::vector<double> times;
  times.reserve(snapshots.size());
  for (const Snapshot& snapshot : snapshots) times.push_back(snapshot.time);
  cf::write_axes(file, axes, times, metadata.x_edges);
  for (std::size_t i = 0; i < fields.size(); ++i) write_field(file, field_ids[i], *fields[i], snapshots);
  for (std::size_t i = 0; i < scalar_ids.size(); ++i)
    write_scalar(file, scalar_ids[i], output::scalars()[i], snapshots);
  write_events(file, events.variables, metadata);
  write_fronts(file, front_ids, metadata.fronts);
  file.write(state, solver_state);
  if (!scenario_in_attribute) file.write(scenario, metadata.scenario_text);
}

}  // namespace

std::vector<std::string> pulse_variables() {
  std::vector<std::string> names;
  for (const FieldVariable& field : field_variables()) names.emplace_back(field.about.name);
  return names;
}

void write_pulse(const std::string& path, const PulseMetadata& metadata, const std::vector<Snapshot>& snapshots,
                 const std::string& solver_state, bool finished) {
  const Fields fields = chosen_fields(metadata.variables);
  check(metadata, snapshots, fields);
  const std::size_t cells = metadata.x_edges.size() - 1;
  const std::size_t arrivals = metadata.fronts.x.size() * (1 + output::front_columns().size() * metadata.events.size());
  const std::size_t values =
      snapshots.size() * (fields.size() * cells + output::scalars().size()) + 3 * cells + arrivals;
  write_netcdf(path, values * sizeof(double) + solver_state.size() + (1 << 16),
               [&](Writer& file) { fill(file, metadata, snapshots, solver_state, finished, fields); });
}

}  // namespace slipfront::record
