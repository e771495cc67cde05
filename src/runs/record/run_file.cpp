#include "runs/record/run_file.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <limits>
#include <numeric>
#include <stdexcept>

#include "math/constants.hpp"
#include "runs/record/arrays.hpp"
#include "runs/record/netcdf/netcdf.hpp"
#include "slipfront/error.hpp"

namespace slipfront::record {
namespace {

using output::Profile;
using output::Snapshot;

constexpr std::vector<double> Profile::*every_field[] = {&Profile::k, &Profile::U,    &Profile::W,
                                                         &Profile::H, &Profile::slip, &Profile::trains};

constexpr FieldVariable every_variable[] = {
    {{"k", "dislocation density (2 pi times dislocations per length)", "A / b", "Eqs. 4-5"}, &Profile::k},
    {{"Sigma", "shear stress, averaged over a period of the train (equal to k)", "mu A / pi", "Eq. 5"}, &Profile::k},
    {{"U", "velocity of the dislocations", "c", "Eq. 4"}, &Profile::U},
    {{"W", "slip velocity, averaged over a period of the train", "c A / pi", "Eq. 5"}, &Profile::W},
    {{"H", "energy density", "mu A^2 b / (2 pi^2 (1 - nu))", "Eq. 6"}, &Profile::H},
    {{"slip", "slip since time 0", "b / (2 pi)", "Eq. 4"}, &Profile::slip},
    {{"stress_drop", "Sigma at the first time less Sigma", "mu A / pi", "Eq. 5"}, &Profile::k, true},
    {{"trains", "number of trains of dislocations at the same position", "", "docs/theory/9_trains.md"},
     &Profile::trains,
     false,
     true},
};

}  // namespace

std::vector<double> FieldVariable::of(const Snapshot& snapshot, const Snapshot& first) const {
  std::vector<double> row = snapshot.profile.*values;
  for (std::size_t i = 0; drop && i < row.size(); ++i) row[i] = (first.profile.*values)[i] - row[i];
  return row;
}

std::span<const FieldVariable> field_variables() { return every_variable; }

std::span<std::vector<double> Profile::*const> profile_fields() { return every_field; }

std::vector<const FieldVariable*> chosen_fields(const std::vector<std::string>& names) {
  std::string known;
  for (const FieldVariable& field : every_variable)
    known += (known.empty() ? "" : ", ") + std::string(field.about.name);
  for (const std::string& name : names)
    if (std::none_of(std::begin(every_variable), std::end(every_variable),
                     [&](const auto& field) { return field.about.name == name; }))
      throw InputError({.key = "output.variables", .value = name, .problem = "unknown variable", .allowed = known});

  const auto named = [&](std::string_view name) { return std::find(names.begin(), names.end(), name) != names.end(); };
  const bool drop_alone = named("stress_drop") && !named("k") && !named("Sigma");
  std::vector<const FieldVariable*> chosen;
  for (const FieldVariable& field : every_variable)
    if ((names.empty() && !field.on_request) || named(field.about.name) || (drop_alone && field.about.name == "Sigma"))
      chosen.push_back(&field);
  return chosen;
}

const FieldVariable* holder(const std::vector<const FieldVariable*>& written, std::vector<double> Profile::*values) {
  for (const FieldVariable* field : written)
    if (field->values == values && !field->drop) return field;
  return nullptr;
}

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
  if (with_reference) file.attribute(variable, "references", "slipfront, src/runs/record");
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

namespace {

using netcdf::Writer;
using output::Snapshot;
using ComparedLevels = std::vector<ComparedLevel>;

/// Names as rows of equal length: what CF calls a label.
struct Labels {
  std::size_t width = 1;
  std::string text;
};
Labels labels_of(const ComparedLevels& levels) {
  Labels labels;
  for (const ComparedLevel& level : levels) labels.width = std::max(labels.width, level.name.size());
  for (const ComparedLevel& level : levels) {
    labels.text += level.name;
    labels.text.append(labels.width - level.name.size(), '\0');
  }
  return labels;
}

/// All of the file.
void fill(Writer& file, const RunMetadata& metadata, const std::vector<double>& times, const ComparedLevels& levels,
          bool finished) {
  const Labels labels = labels_of(levels);
  Levels snapshots;
  std::vector<double> scales;
  for (const ComparedLevel& level : levels) {
    snapshots.push_back(&level.snapshots);
    scales.push_back(level.scale.value_or(none));
  }
  std::vector<Array> arrays = arrays_of(metadata, times, snapshots);
  for (Array& array : arrays)
    if (array.dimensions.front().name == "level") array.attributes.emplace_back("coordinates", "name scale");
  arrays.push_back({output::scale_factor, {{"level", levels.size()}}, [scales] { return scales; }, {}});
  cf::describe_file(file, metadata, comparison_format, finished);
  const Defined defined = define(file, arrays, metadata);
  const int name = file.characters("name", {defined.dimensions.at("level"), file.dimension("letters", labels.width)});
  file.attribute(name, "long_name", "level of theory");
  file.end_definitions();
  if (!levels.empty()) file.write_all(name, labels.text);  // a dimension of size 0 is an unlimited one
  write(file, defined, arrays);
}

}  // namespace

void write_comparison(const std::string& path, const RunMetadata& metadata, const std::vector<double>& times,
                      const ComparedLevels& levels, bool finished) {
  const auto fields = chosen_fields(metadata.variables);
  const std::size_t cells = metadata.x_edges.size() - 1;
  for (const ComparedLevel& level : levels) {
    if (level.snapshots.size() != times.size())
      throw std::invalid_argument("write_comparison: a level is not finished");
    for (const Snapshot& snapshot : level.snapshots)
      for (const FieldVariable* field : fields)
        if ((snapshot.profile.*field->values).size() != cells)
          throw std::invalid_argument("write_comparison: a profile has not as many cells as x");
  }
  write_netcdf(path, 0, [&](Writer& file) { fill(file, metadata, times, levels, finished); });
}

}  // namespace slipfront::record
