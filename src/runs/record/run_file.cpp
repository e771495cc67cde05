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

void write_run(const std::string& path, const RunMetadata& metadata, const std::vector<Array>& arrays,
               const std::string& state, bool finished) {
  const std::string& scenario = metadata.scenario_text;
  const Attributes by = {{"references", "slipfront, src/runs/record"}};
  Dataset file = dataset_of(arrays, metadata, finished);
  file.add_opaque(layout::solver_state, "state of the run, to resume it", state, by);
  if (clean_text(scenario, netcdf::longest_text) != scenario)  // else its attribute has every byte
    file.add_opaque(layout::scenario_bytes, "the scenario, byte by byte", scenario, by);
  write_dataset(path, file);
}

std::vector<std::string> pulse_variables() {
  std::vector<std::string> names;
  for (const FieldVariable& field : field_variables()) names.emplace_back(field.about.name);
  return names;
}

void write_comparison(const std::string& path, const RunMetadata& metadata, const std::vector<Array>& arrays,
                      const std::vector<Level>& levels, bool finished) {
  Dataset file = dataset_of(arrays, metadata, finished);
  for (DatasetVariable& variable : file.variables)
    if (variable.dimensions.front() == "level" && variable.dimensions.size() > 1)
      variable.attributes.emplace_back("coordinates", "name scale");
  std::vector<std::string> names;
  names.reserve(levels.size());
  for (const Level& level : levels) names.push_back(level.name);
  file.variables.push_back({"name", {"level"}, names, {{"long_name", "level of theory"}}});
  write_dataset(path, file);
}

}  // namespace slipfront::record
