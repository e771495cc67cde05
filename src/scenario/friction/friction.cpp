// The table [friction] of a scenario.

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "foundation/text/digits.hpp"
#include "friction/state/contacts.hpp"
#include "scenario/friction/friction_curve.hpp"
#include "scenario/friction/friction_units.hpp"
#include "scenario/settings.hpp"
#include "scenario/text/section.hpp"

namespace slipfront::scenario {

using friction::Closure;
using friction::Definition;
using friction::Parameter;

namespace {

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

/// The parameters of all laws, each name once.
std::vector<const Parameter*> all_parameters() {
  std::vector<const Parameter*> all;
  for (const Definition* law : friction::laws())
    for (const Parameter& p : law->parameters)
      if (std::none_of(all.begin(), all.end(), [&](const Parameter* other) { return other->name == p.name; }))
        all.push_back(&p);
  return all;
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

double read_parameter(const Section& section, const Parameter& p, FrictionUnits& units) {
  if (!p.words.empty()) {
    std::vector<std::pair<std::string_view, double>> words;
    for (const std::string_view word : p.words) words.emplace_back(word, static_cast<double>(words.size()));
    return section.choice<double>(p.name, words).value_or(p.value);
  }
  const Limits limits{.least = p.least, .most = p.most, .without_least = p.without_least};
  const double value = units.in_model(p);
  if (!limits.hold(value)) throw section.refuse(p.name, "out of range", limits.text());
  return value;
}

/// Checks that keys of contacts and pores which need each other are given together.
void check_contacts(const Section& section, const friction::Contacts& contacts, Scenario& scenario) {
  const auto needs = [&](std::string_view key, double value, std::string_view other, double other_value) {
    if (section.has(key) && !(value > 0)) throw section.refuse(key, "out of range", "> 0");
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

}  // namespace

void read_friction(const Document& document, const TableReader& tables, Scenario& scenario) {
  const std::vector<const Parameter*> parameters = all_parameters();
  const Section section(document, "friction");
  FrictionUnits units(section);
  std::vector<std::pair<std::string_view, const Definition*>> names;
  for (const Definition* law : friction::laws()) names.emplace_back(law->name, law);
  const auto named = section.choice<const Definition*>("law", names);
  const Definition& law = named ? **named : scenario.friction.definition();
  Errors errors;
  for (const Parameter* p : parameters)
    if (section.has(p->name) && law.find(p->name) == nullptr)
      errors.attempt([&] { read_parameter(section, *p, units); });
  std::vector<double> values;
  for (const Parameter& p : law.parameters)
    errors.attempt([&] { values.push_back(read_parameter(section, p, units)); });
  errors.throw_if_any();
  const Closure closure =
      section.choice<Closure>("closure", {{"consistent", Closure::consistent}, {"paper", Closure::paper}})
          .value_or(scenario.friction.closure());
  for (const Parameter* p : parameters)
    if (section.has(p->name) && !named)
      throw section.refuse(p->name, "friction.law is missing", "with law = " + laws_with(""));
  refuse_keys_of_others(section, law);
  if (section.has("normal_stress") && std::none_of(law.parameters.begin(), law.parameters.end(), has_coefficient))
    throw section.refuse("normal_stress", "friction.law has no friction coefficient", "leave it out");
  for (const Parameter& p : law.parameters)
    if (!p.if_missing.empty() && !section.has(p.name))
      scenario.warnings.push_back("friction." + std::string(p.name) + " is not given and " + std::string(p.if_missing));
  scenario.friction = friction::Friction(law, std::move(values), closure, read_curve(section, tables, law.curve));
  check_contacts(section, scenario.friction.contacts(), scenario);
}

}  // namespace slipfront::scenario
