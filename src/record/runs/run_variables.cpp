#include "record/runs/run_variables.hpp"

#include <algorithm>
#include <iterator>

#include "slipfront/error.hpp"

namespace slipfront::record {
namespace {

using output::Profile;
using output::Snapshot;

constexpr std::vector<double> Profile::*every_field[] = {&Profile::k, &Profile::U,    &Profile::W,
                                                         &Profile::H, &Profile::slip, &Profile::trains};

constexpr FieldVariable fields[] = {
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

std::span<const FieldVariable> field_variables() { return fields; }

std::span<std::vector<double> Profile::*const> profile_fields() { return every_field; }

std::vector<const FieldVariable*> chosen_fields(const std::vector<std::string>& names) {
  std::string known;
  for (const FieldVariable& field : fields) known += (known.empty() ? "" : ", ") + std::string(field.about.name);
  for (const std::string& name : names)
    if (std::none_of(std::begin(fields), std::end(fields), [&](const auto& field) { return field.about.name == name; }))
      throw InputError({.key = "output.variables", .value = name, .problem = "unknown variable", .allowed = known});

  const auto named = [&](std::string_view name) { return std::find(names.begin(), names.end(), name) != names.end(); };
  const bool drop_alone = named("stress_drop") && !named("k") && !named("Sigma");
  std::vector<const FieldVariable*> chosen;
  for (const FieldVariable& field : fields)
    if ((names.empty() && !field.on_request) || named(field.about.name) || (drop_alone && field.about.name == "Sigma"))
      chosen.push_back(&field);
  return chosen;
}

const FieldVariable* holder(const std::vector<const FieldVariable*>& written, std::vector<double> Profile::*values) {
  for (const FieldVariable* field : written)
    if (field->values == values && !field->drop) return field;
  return nullptr;
}

}  // namespace slipfront::record
