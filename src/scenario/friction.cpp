// The table [friction] of a scenario.

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "friction/state/contacts.hpp"
#include "math/digits.hpp"
#include "scenario/document.hpp"
#include "scenario/formula.hpp"
#include "scenario/functions.hpp"
#include "scenario/readers.hpp"
#include "scenario/section.hpp"

namespace slipfront::scenario {
namespace {

using friction::Closure;
using friction::Definition;
using friction::Dimension;
using friction::Parameter;
constexpr std::string_view normal_stress = "normal_stress";

ModelUnit model_unit(Dimension dimension) {
  switch (dimension) {
    case Dimension::force:
      return ModelUnit::force;
    case Dimension::slip:
      return ModelUnit::slip;
    case Dimension::time:
      return ModelUnit::time;
    case Dimension::velocity:
      return ModelUnit::slip_velocity;
    case Dimension::pressure:
    case Dimension::number:
      break;
  }
  return ModelUnit::none;
}

medium::Dimension kind_of(Dimension dimension) {
  return dimension == Dimension::pressure ? medium::Dimension::pressure : dimension_of(model_unit(dimension));
}

/// The parameters of all laws, each name once.
std::vector<const Parameter*> all_parameters() {
  std::vector<const Parameter*> all;
  for (const Definition* law : friction::laws())
    for (const Parameter& p : law->parameters)
      if (std::none_of(all.begin(), all.end(), [&](const Parameter* other) { return other->name == p.name; }))
        all.push_back(&p);
  return all;
}

}  // namespace

FrictionUnits::FrictionUnits(const Section& friction, const TableReader& tables, const Interface& interface)
    : friction_(friction), along_(friction, tables, interface) {
  const Value* const pressed = friction.find(normal_stress);
  for (const Parameter* p : all_parameters()) {
    const Value* const value = friction.find(p->name);
    vary_ = vary_ || (value && p->words.empty() && varies(*value));
  }
  if (!pressed || !varies(*pressed)) return;
  const friction::AlongInterface along =
      along_.in_range(along_.read(normal_stress, *pressed, ModelUnit::none, {.least = 0, .without_least = true}));
  vary_ = true;
  largest_normal_stress_ = along.most;
  if (!along.at) return;
  share_ = {[at = along.at, most = along.most](double x, double y) { return at(x, y) / most; },
            along.least / along.most, 1};
}

double FrictionUnits::normal_stress_in_si() const {
  if (largest_normal_stress_ > 0) return largest_normal_stress_;
  const double pressed = friction_.quantity(normal_stress, *friction_.find(normal_stress), medium::Dimension::pressure);
  if (!(pressed > 0)) throw friction_.refuse(normal_stress, "not positive", "> 0");
  return pressed;
}

ModelUnit FrictionUnits::unit_of(const Parameter& p) { return model_unit(p.dimension); }

double FrictionUnits::si_of(const Parameter& p) const {
  if (p.dimension == Dimension::pressure) {
    if (!friction_.has(normal_stress))
      throw friction_.refuse(p.name, "in SI units it needs friction.normal_stress",
                             "friction.normal_stress, or a number: a share of the normal stress");
    return normal_stress_in_si();
  }
  return friction_.si(p.name, model_unit(p.dimension));
}

friction::AlongInterface FrictionUnits::in_model(const Parameter& p) const {
  const Value* const value = friction_.find(p.name);
  const bool age_varies = value && varies(*value) && p.name == "contact_time";  // only the number 0 means no age
  const Limits limits{.least = p.least, .most = p.most, .without_least = p.without_least || age_varies};
  if (value && varies(*value)) {
    const bool force = p.dimension == Dimension::force, coefficient = force && friction_.has(normal_stress);
    const bool in_units = !coefficient && (!force || (p.unit == friction::force_unit && !has_curve()));
    const AlongReader::At along = along_.read(p.name, *value, in_units ? unit_of(p) : ModelUnit::none, limits);
    if (!coefficient) return along_.in_range(along);
    return along_.in_range(
        [along, unit = normal_stress_in_si() / si_of(p)](double x, double y) { return unit * along(x, y); });
  }
  const double number = uniform(p);
  if (!limits.hold(number) && !std::isnan(number))  // NaN: the constants of the medium have an error
    throw friction_.refuse(p.name, "out of range", limits.text());
  const bool stress = value && value->kind == Value::Kind::text &&
                      (p.dimension == Dimension::force || p.dimension == Dimension::pressure);
  if (!share_ || !stress) return {nullptr, number, number};
  return along_.in_range([share = share_->at, number](double x, double y) { return number / share(x, y); });
}

double FrictionUnits::uniform(const Parameter& p) const {
  const Value* const value = friction_.find(p.name);
  const bool force = p.dimension == Dimension::force, number = !value || value->kind == Value::Kind::number;
  const bool coefficient = force && number && friction_.has(normal_stress);
  if (value && (p.dimension == Dimension::number || (number && !coefficient))) {
    friction_.check(p.name, *value, {});
    // The coefficient of a power of w has no SI unit, and that of a formula or a file is a factor.
    if (!force || (p.unit == friction::force_unit && !has_curve())) friction_.check_unit(p.name, *value, unit_of(p));
    return value->number;
  }
  if (value && force && p.unit != friction::force_unit)
    throw friction_.refuse(p.name, "a coefficient of a power of w has no SI unit here", "a number in the model's unit");
  if (!number) return friction_.quantity(p.name, *value, kind_of(p.dimension)) / si_of(p);
  if (!coefficient || (!value && p.value == 0)) return p.value;
  return (value ? value->number : p.value) * normal_stress_in_si() / si_of(p);
}

namespace {

/// Tries the curve at velocities that a `chain` or `pulse` run may need. These are rest, and velocities from far below
/// slow slip to far above earthquakes.
void try_curve(const Section& section, const friction::Curve& curve, double fastest) {
  const double at_rest = curve(0);
  double greatest = 0;
  constexpr int samples = 320;
  constexpr double slowest = 1e-12;
  for (int i = 0; i <= samples; ++i)
    greatest = std::fmax(greatest, curve(slowest * std::pow(fastest / slowest, static_cast<double>(i) / samples)));
  // A steep law, such as w^0.1, approaches f(0) only at far smaller velocities. A jump remains at any velocity.
  constexpr double nearest_rest = 1e-300;
  const double near_rest = curve(nearest_rest);
  if (std::fabs(near_rest - at_rest) > 1e-3 * greatest)
    throw section.refuse(
        "formula", "f jumps from " + shortest(at_rest) + " at w = 0 to " + shortest(near_rest),
        "f(0) is the force that the interface withstands at rest; for a constant force: law = \"coulomb\"");
}

/// The unit of the model in the unit of the curve. With units = "SI" the curve is in Pa, unless its coefficient is a
/// stress, by its unit or by the normal stress. The curve is then a pure number, as it is in the units of the model.
double force_in_file(const Section& section) {
  const Value* const coefficient = section.find("coefficient");
  const bool stress =
      section.has("normal_stress") || (coefficient && coefficient->kind == Value::Kind::text && !varies(*coefficient));
  return stress ? 1 : section.in_file(ModelUnit::force);
}

friction::Curve curve_of_formula(const Section& section) {
  const std::string text = *section.formula("formula");
  const Complaint where = section.where("formula");
  const Formula formula = compiled(section, "formula", text, {"w"});
  const double velocity = section.in_file(ModelUnit::slip_velocity);
  const double force = force_in_file(section);
  friction::Curve curve = [formula, where, velocity, force](double w) {
    const double f = formula(w * velocity) / force;
    if (!(f >= 0 && std::isfinite(f)))
      throw refused_at(where, "the friction is " + shortest(f) + " at the slip velocity w = " + shortest(w),
                       "a finite force >= 0");
    return f;
  };
  try_curve(section, curve, 10);
  return curve;
}

friction::Curve curve_of_table(const Section& section, const TableReader& tables) {
  const Column w{"w", {.least = 0, .most = farthest}, section.in_file(ModelUnit::slip_velocity)};
  const Column f{"f", {.least = 0, .most = largest_stress}, force_in_file(section)};
  const auto curve = std::make_shared<const MonotoneCurve>(TableFile(section, tables).rows(w, f));
  if (curve->first() != 0)
    throw section.refuse("file", "the table begins at w = " + shortest(curve->first()),
                         "a first row with w = 0; its f is the force that the interface withstands at rest");
  return [curve, where = section.where("file")](double speed) {
    if (speed <= curve->last()) return (*curve)(speed);
    throw refused_at(
        where,
        "the table ends at w = " + shortest(curve->last()) + "; the slip velocity " + shortest(speed) + " was reached",
        "a table up to the slip velocities at the centres of dislocations");
  };
}

/// The curve f(w) that [friction] gives: by a formula, or by a table in a file. Null for laws that take none.
/// \throws InputError where it is no force at the speeds tried; the curve itself throws it at speeds found later.
friction::Curve read_curve(const Section& section, const TableReader& tables, friction::CurveSource source, bool vary) {
  const bool formula = source == friction::CurveSource::formula, table = source == friction::CurveSource::table;
  for (const auto& [key, wanted, law] :
       {std::tuple("formula", formula, "formula"), std::tuple("file", table, "table")}) {
    const std::string with = "with law = \"" + std::string(law) + '"';
    if (section.has(key) && !wanted) throw section.refuse(key, "contradicts friction.law", with);
    if (!section.has(key) && wanted) throw section.refuse(key, "missing", std::string("friction.law needs it"));
  }
  if (!formula && !table && !vary && section.in_si())
    throw section.refuse("units", "concerns formulas and files only", "texts with units, such as \"1 um/s\"");
  if (formula) return curve_of_formula(section);
  if (table) return curve_of_table(section, tables);
  return {};
}

/// Lists the laws that have the parameter `key`, such as: "viscous", "coulomb" or "power". If `key` is empty, it lists
/// all laws that have parameters.
std::string laws_with(std::string_view key) {
  std::vector<std::string> names;
  for (const Definition* law : friction::laws())
    if (key.empty() ? !law->parameters.empty() : law->find(key) != nullptr)
      names.push_back('"' + std::string(law->name) + '"');
  std::string text;
  for (std::size_t i = 0; i < names.size(); ++i)
    text += (i == 0 ? "" : i + 1 == names.size() ? " or " : ", ") + names[i];
  return text;
}

/// Rejects a key without effect, because it is probably a mistake of the user.
void refuse_keys_of_others(const Section& section, const Definition& law) {
  for (const Parameter* p : all_parameters()) {
    if (!section.has(p->name) || law.find(p->name) != nullptr) continue;
    const std::string key(p->name);
    if (laws_with(key) == laws_with(""))  // every law with parameters has this key
      throw section.refuse(key, "contradicts law = \"" + std::string(law.name) + '"',
                           "leave it out, or change friction.law");
    throw section.refuse(key, "contradicts friction.law, which has no " + key, "with law = " + laws_with(key));
  }
}

/// Whether the parameter is a force, which the user may give as a friction coefficient and a normal stress.
bool has_coefficient(const Parameter& p) { return p.unit == friction::force_unit; }

friction::AlongInterface read_parameter(const Section& section, const Parameter& p, const FrictionUnits& units) {
  if (p.words.empty()) return units.in_model(p);
  const double word = section.has(p.name) ? static_cast<double>(section.word(p.name)) : p.value;
  return {nullptr, word, word};
}

/// Checks that keys of contacts and pores which need each other are given together.
void check_contacts(const Section& section, const friction::Contacts& contacts, Scenario& scenario) {
  const auto needs = [&](std::string_view key, double value, std::string_view other, double other_value) {
    if (section.has(key) && value <= 0) throw section.refuse(key, "out of range", "> 0");
    if (section.has(key) && !(other_value > 0))
      throw section.refuse(key, "has no effect without friction." + std::string(other),
                           "leave it out, or with " + std::string(other) + " > 0");
  };
  needs("contact_time", contacts.age, "contact_ageing", contacts.ageing);
  needs("drainage_time", contacts.drainage, "dilatancy", contacts.dilatancy);
  if (contacts.ambient >= 1)
    throw section.refuse("pore_pressure", "the effective normal stress would be " + shortest(1 - contacts.ambient),
                         "less than the normal stress: a share >= 0 and < 1");
  if (contacts.ambient > 0) needs("pore_pressure", contacts.ambient, "dilatancy", contacts.dilatancy);
  if (contacts.ageing > 0 && !section.has("contact_time"))
    throw section.refuse("contact_time", "missing", "> 0: the age theta_c to which friction.contact_ageing refers");
  if (contacts.dilatancy > 0 && !section.has("drainage_time"))
    scenario.warnings.push_back("friction.drainage_time is not given: the pores never drain");
}

using VaryingParameters = std::vector<std::pair<std::string_view, friction::AlongInterface>>;

/// The friction with the parameters and the normal stress that vary.
friction::Friction varied(const Section& section, friction::Friction friction, const FrictionUnits& units,
                          const VaryingParameters& varying) {
  try {
    if (const auto& share = units.share_of_normal_stress()) friction = friction.under(*share);
    for (const auto& [parameter, along] : varying) friction = friction.with(parameter, along);
  } catch (const InputError& error) {
    throw section.refuse(error.complaint().key, error.complaint().problem, error.complaint().allowed);
  }
  return friction;
}

}  // namespace

void read_friction(const Document& document, const TableReader& tables, const RawStress& raw, Scenario& scenario) {
  const std::vector<const Parameter*> parameters = all_parameters();
  const Section section(document, "friction");
  const Domain& domain = scenario.domain;
  const FrictionUnits units(section, tables,
                            interface_of(document, domain, trial_range(domain, scenario.initial.reach, raw.covers)));
  const bool named = section.has("law");
  const Definition& law = named ? *friction::laws()[section.word("law")] : scenario.friction.definition();
  Errors errors;
  for (const Parameter* p : parameters)
    if (section.has(p->name) && law.find(p->name) == nullptr)
      errors.attempt([&] { read_parameter(section, *p, units); });
  std::vector<double> values;
  VaryingParameters varying;
  for (const Parameter& p : law.parameters)
    errors.attempt([&] {
      const friction::AlongInterface along = read_parameter(section, p, units);
      values.push_back(along.most);
      if (along.at) varying.emplace_back(p.name, along);
    });
  errors.throw_if_any();
  Closure closure = scenario.friction.closure();
  section.read("closure", closure);
  for (const Parameter* p : parameters)
    if (section.has(p->name) && !named)
      throw section.refuse(p->name, "friction.law is missing", "with law = " + laws_with(""));
  refuse_keys_of_others(section, law);
  if (section.has("normal_stress") && std::none_of(law.parameters.begin(), law.parameters.end(), has_coefficient))
    throw section.refuse("normal_stress", "friction.law has no friction coefficient", "leave it out");
  for (const Parameter& p : law.parameters)
    if (!p.if_missing.empty() && !section.has(p.name))
      scenario.warnings.push_back("friction." + std::string(p.name) + " is not given and " + std::string(p.if_missing));
  friction::Friction friction(law, std::move(values), closure, read_curve(section, tables, law.curve, units.vary()));
  scenario.friction = varied(section, std::move(friction), units, varying);
  check_contacts(section, scenario.friction.contacts(), scenario);
}

}  // namespace slipfront::scenario
