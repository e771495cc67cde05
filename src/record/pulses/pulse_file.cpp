#include "record/pulses/pulse_file.hpp"

#include <cmath>
#include <cstddef>
#include <stdexcept>

#include "record/netcdf/netcdf.hpp"
#include "record/pulses/arrays.hpp"
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
    require(snapshots[i].displacement.size() == metadata.sites.size(), "the displacement has not as many sites");
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

/// All of the file.
void fill(Writer& file, const PulseMetadata& metadata, const std::vector<Snapshot>& snapshots,
          const std::string& solver_state, bool finished, const Fields& fields, const std::vector<Array>& arrays) {
  const bool scenario_in_attribute = describe_file(file, metadata, finished);
  file.attribute(Writer::global, "checksum",
                 layout::checksum(metadata.scenario_text, solver_state, finished, snapshots, fields));
  const Defined defined = define(file, arrays, metadata);
  const int state = opaque(file, layout::solver_state, "state of the solver, to resume the run", solver_state.size());
  const int scenario = scenario_in_attribute ? -1
                                             : opaque(file, layout::scenario_bytes, "the scenario, byte by byte",
                                                      metadata.scenario_text.size());
  file.end_definitions();
  write(file, defined, arrays);
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
  const std::vector<Array> arrays = arrays_of(metadata, times_of(snapshots), {&snapshots}, false);
  std::size_t values = 0;
  for (const Array& array : arrays) {
    std::size_t size = 1;
    for (const Array::Dimension& dimension : array.dimensions) size *= dimension.size;
    values += size;
  }
  write_netcdf(path, values * sizeof(double) + solver_state.size() + (1 << 16),
               [&](Writer& file) { fill(file, metadata, snapshots, solver_state, finished, fields, arrays); });
}

}  // namespace slipfront::record
