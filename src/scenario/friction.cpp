// The table [friction] of a scenario.

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "friction_curve.hpp"
#include "section.hpp"
#include "settings.hpp"

namespace slipfront::scenario {

using friction::Closure;
using friction::Definition;
using friction::Parameter;

namespace {

/// "viscous", "coulomb" or "power": the laws with a parameter, or with any where `key` is empty.
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

/// Every key that some law has, once.
std::vector<const Parameter*> all_parameters() {
  std::vector<const Parameter*> all;
  for (const Definition* law : friction::laws())
    for (const Parameter& p : law->parameters)
      if (std::none_of(all.begin(), all.end(), [&](const Parameter* other) { return other->name == p.name; }))
        all.push_back(&p);
  return all;
}

/// A key without effect is a misunderstanding, better said now than found in the results.
void refuse_keys_of_others(const Section& section, const Definition& law) {
  for (const Parameter* p : all_parameters()) {
    if (!section.has(p->name) || law.find(p->name) != nullptr) continue;
    const std::string key(p->name);
    if (laws_with(key) == laws_with(""))  // any friction at all
      throw section.refuse(key, "contradicts law = \"" + std::string(law.name) + '"',
                           "leave it out, or change friction.law");
    throw section.refuse(key, "contradicts friction.law, which has no " + key, "with law = " + laws_with(key));
  }
}

double read_parameter(const Section& section, const Parameter& p) {
  if (!p.words.empty()) {
    std::vector<std::pair<std::string_view, double>> words;
    for (const std::string_view word : p.words) words.emplace_back(word, static_cast<double>(words.size()));
    return section.choice<double>(p.name, words).value_or(p.value);
  }
  return section.number(p.name, {.least = p.least, .most = p.most, .without_least = p.without_least}).value_or(p.value);
}

}  // namespace

void read_friction(const Document& document, const TableReader& tables, Scenario& scenario) {
  const std::vector<const Parameter*> parameters = all_parameters();
  std::vector<std::string_view> keys = {"law"};
  for (const Parameter* p : parameters) keys.push_back(p->name);
  keys.insert(keys.end(), {"formula", "file", "closure"});
  const Section section(document, "friction", keys);
  std::vector<std::pair<std::string_view, const Definition*>> names;
  for (const Definition* law : friction::laws()) names.emplace_back(law->name, law);
  const auto named = section.choice<const Definition*>("law", names);
  const Definition& law = named ? **named : scenario.friction.definition();
  for (const Parameter* p : parameters)
    if (law.find(p->name) == nullptr) read_parameter(section, *p);
  std::vector<double> values;
  for (const Parameter& p : law.parameters) values.push_back(read_parameter(section, p));
  const Closure closure =
      section.choice<Closure>("closure", {{"consistent", Closure::consistent}, {"paper", Closure::paper}})
          .value_or(scenario.friction.closure());
  for (const Parameter* p : parameters)
    if (section.has(p->name) && !named)
      throw section.refuse(p->name, "friction.law is missing", "with law = " + laws_with(""));
  refuse_keys_of_others(section, law);
  for (const Parameter& p : law.parameters)
    if (!p.if_missing.empty() && !section.has(p.name))
      scenario.warnings.push_back("friction." + std::string(p.name) + " is not given and " + std::string(p.if_missing));
  scenario.friction = friction::Friction(law, std::move(values), closure, read_curve(section, tables, law.curve));
}

}  // namespace slipfront::scenario
