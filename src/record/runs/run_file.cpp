#include "record/runs/run_file.hpp"

#include <cmath>
#include <cstddef>
#include <stdexcept>

#include "record/netcdf/netcdf.hpp"
#include "record/runs/arrays.hpp"
#include "record/runs/cf.hpp"
#include "record/runs/run_layout.hpp"
#include "record/runs/run_variables.hpp"

namespace slipfront::record {
namespace {

using netcdf::Writer;
using output::Snapshot;
using Fields = std::vector<const FieldVariable*>;

void require(bool truth, const char* what) {
  if (!truth) throw std::invalid_argument(std::string("write_pulse: ") + what);
}

void check(const RunMetadata& metadata, const std::vector<Snapshot>& snapshots, const Fields& fields) {
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

/// Defines a variable of bytes that mean nothing to anyone else.
int opaque(Writer& file, const std::string& name, const std::string& long_name, std::size_t size, bool with_reference) {
  const int variable = file.bytes(name, {file.dimension(name + "_bytes", size)});
  file.attribute(variable, "long_name", long_name);
  file.attribute(variable, "units", "1");
  if (with_reference) file.attribute(variable, "references", "slipfront, src/record");
  return variable;
}

std::size_t bytes_of(const std::vector<Array>& arrays) {
  std::size_t values = 0;
  for (const Array& array : arrays) {
    std::size_t size = 1;
    for (const Array::Dimension& dimension : array.dimensions) size *= dimension.size;
    values += size;
  }
  return values * sizeof(double);
}

}  // namespace

void write_run(const std::string& path, const RunMetadata& metadata, const std::vector<Array>& arrays,
               const std::string& state, bool finished, const std::string& checksum) {
  const bool on_line = !checksum.empty();
  const std::string& scenario = metadata.scenario_text;
  const bool in_attribute = on_line && clean_text(scenario, netcdf::longest_text) == scenario;
  write_netcdf(path, bytes_of(arrays) + state.size() + (1 << 16), [&](Writer& file) {
    cf::describe_file(file, metadata, on_line ? pulse_format : plane_format, finished);
    if (on_line) file.attribute(Writer::global, "checksum", checksum);
    const Defined defined = define(file, arrays, metadata);
    const int saved = opaque(file, layout::solver_state,
                             on_line ? "state of the solver, to resume the run" : "state of the run, to resume it",
                             state.size(), on_line);
    const int text = in_attribute
                         ? -1
                         : opaque(file, layout::scenario_bytes, "the scenario, byte by byte", scenario.size(), on_line);
    file.end_definitions();
    write(file, defined, arrays);
    file.write(saved, state);
    if (!in_attribute) file.write(text, scenario);
  });
}

std::vector<std::string> pulse_variables() {
  std::vector<std::string> names;
  for (const FieldVariable& field : field_variables()) names.emplace_back(field.about.name);
  return names;
}

void write_pulse(const std::string& path, const RunMetadata& metadata, const std::vector<Snapshot>& snapshots,
                 const std::string& solver_state, bool finished) {
  const Fields fields = chosen_fields(metadata.variables);
  check(metadata, snapshots, fields);
  write_run(path, metadata, arrays_of(metadata, snapshots), solver_state, finished,
            layout::checksum(metadata.scenario_text, solver_state, finished, snapshots, fields));
}

}  // namespace slipfront::record
