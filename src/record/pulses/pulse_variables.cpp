#include "record/pulses/pulse_variables.hpp"

#include <algorithm>
#include <iterator>

#include "output/further_scalars.hpp"
#include "slipfront/error.hpp"

namespace slipfront::record {
namespace {

using output::Energy;
using output::Fronts;
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

template <auto... path>
double get(const Snapshot& snapshot) {
  return (snapshot.*....*path);
}

template <auto... path>
void set(Snapshot& snapshot, double value) {
  (snapshot.*....*path) = value;
}

template <auto... path>
constexpr ScalarVariable scalar(Description about) {
  return {about, get<path...>, set<path...>};
}

template <auto... path>
constexpr ScalarVariable absentable(Description about) {
  return {about, get<path...>, set<path...>, true};
}

/// From docs/theory/1_chain.md: F_d b / (2 pi) an asperity, 1 / A asperities in the unit of x, a chain of width b.
constexpr std::string_view energy = "mu b^2 A / (2 pi^2 (1 - nu))";

constexpr ScalarVariable members[] = {
    absentable<&Snapshot::fronts, &Fronts::trailing>(
        {"trailing_front", "position of the fast front, the foot of the slip velocity on the stressed side", "b / A",
         "Eqs. 8-10"}),
    absentable<&Snapshot::fronts, &Fronts::trailing_characteristic>(
        {"trailing_characteristic", "position of the fast front as a characteristic", "b / A", "Eqs. 8-10"}),
    absentable<&Snapshot::fronts, &Fronts::leading>(
        {"leading_front", "position of the slow front, into the less stressed side", "b / A", "Eqs. 8-10"}),
    absentable<&Snapshot::fronts, &Fronts::trailing_observed>(
        {"trailing_front_observed", "where slip is first seen by an observer with a threshold, from the stressed side",
         "b / A", "Eqs. 8-10"}),
    absentable<&Snapshot::fronts, &Fronts::leading_observed>(
        {"leading_front_observed", "where slip is first seen by an observer with a threshold, from the other side",
         "b / A", "Eqs. 8-10"}),
    scalar<&Snapshot::energy, &Energy::elastic>(
        {"energy_elastic", "energy of the state at rest with the same density", energy, "Eq. 6"}),
    scalar<&Snapshot::energy, &Energy::kinetic>({"energy_kinetic", "energy less the elastic energy", energy, "Eq. 6"}),
    scalar<&Snapshot::energy, &Energy::dissipated>(
        {"energy_dissipated", "energy lost to friction since time 0", energy, "Eq. 7"}),
    scalar<&Snapshot::energy, &Energy::supplied>(
        {"energy_supplied", "energy supplied by the forcing since time 0", energy, "Eq. 7"}),
    absentable<&Snapshot::energy, &Energy::through_ends>(
        {"energy_through_ends", "energy that came in through the ends of the domain since time 0", energy, "Eq. 7"}),
    absentable<&Snapshot::energy, &Energy::shocks>(
        {"energy_shocks", "rest of the balance of energy: what is lost where trains run into each other, and errors",
         energy, "Eq. 7"}),
    absentable<&Snapshot::energy, &Energy::phonons>(
        {"energy_phonons", "energy of a chain less that of uniform trains with its averages", energy, "Eq. 6"}),
    absentable<&Snapshot::slip_velocity_at_origin>(
        {"slip_velocity_at_origin", "slip velocity at x = 0", "c A / pi", "Eq. 5"}),
    absentable<&Snapshot::stress_at_origin>({"stress_at_origin", "shear stress at x = 0", "mu A / pi", "Eq. 5"}),
    absentable<&Snapshot::slip_at_origin>({"slip_at_origin", "slip at x = 0 since time 0", "b / (2 pi)", "Eq. 4"}),
    scalar<&Snapshot::peak_slip_velocity>({"peak_slip_velocity", "greatest slip velocity", "c A / pi", "Eq. 5"}),
    absentable<&Snapshot::peak_position>({"peak_position", "position of the greatest slip velocity", "b / A", "Eq. 5"}),
};

}  // namespace

std::vector<double> FieldVariable::of(const Snapshot& snapshot, const Snapshot& first) const {
  std::vector<double> row = snapshot.profile.*values;
  for (std::size_t i = 0; drop && i < row.size(); ++i) row[i] = (first.profile.*values)[i] - row[i];
  return row;
}

std::span<const FieldVariable> field_variables() { return fields; }

double ScalarVariable::get(const Snapshot& snapshot) const {
  return member ? member(snapshot) : output::further_scalar(snapshot, about.name);
}

void ScalarVariable::set(Snapshot& snapshot, double value) const {
  if (member)
    set_member(snapshot, value);
  else
    snapshot.further[std::string(about.name)] = value;
}

std::span<const ScalarVariable> scalar_variables() {
  static const std::vector<ScalarVariable> all = [] {
    std::vector<ScalarVariable> scalars(std::begin(members), std::end(members));
    for (const Description& about : output::further_scalars()) scalars.push_back({about, nullptr, nullptr, true});
    return scalars;
  }();
  return all;
}
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
