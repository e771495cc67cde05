#include "slipfront/scenario/keys.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "foundation/text/digits.hpp"
#include "slipfront/friction/friction.hpp"
#include "slipfront/medium/constants.hpp"
#include "slipfront/scenario/scenario.hpp"

namespace slipfront::scenario {
namespace {

using friction::Definition;
using friction::force_unit;
using friction::Parameter;
using enum KeyType;

constexpr std::string_view position_unit = "b / A", time_unit = "b / (c A)", stress_unit = "mu A / pi",
                           velocity_unit = "c A / pi", pure_number = "1";
constexpr Limits positive{.least = 0, .without_least = true};
constexpr Limits position{.least = -farthest, .most = farthest};
constexpr Limits stress{.least = 0, .most = largest_stress};
constexpr Limits fraction{.least = 0, .most = 1, .without_least = true, .without_most = true};
constexpr Limits tolerance{.least = 1e-12, .most = 0.1};

std::vector<Key> initial_keys() {
  return {
      {.table = "initial",
       .name = "profile",
       .type = word,
       .meaning = "form of the initial stress",
       .otherwise = "step",
       .words = {"step", "tanh", "formula", "table"}},
      {.table = "initial",
       .name = "stress_left",
       .meaning = "stress of a step or tanh at x < 0; 0 is an empty interface",
       .unit = stress_unit,
       .otherwise = "required by step and tanh",
       .limits = stress},
      {.table = "initial",
       .name = "stress_right",
       .meaning = "stress of a step or tanh at x > 0; 0 is an empty interface",
       .unit = stress_unit,
       .otherwise = "required by step and tanh",
       .limits = stress},
      {.table = "initial",
       .name = "width",
       .meaning = "width of a tanh: right + (left - right)(1 - tanh(x / width)) / 2",
       .unit = position_unit,
       .otherwise = "1",
       .limits = {.least = 0, .most = farthest, .without_least = true}},
      {.table = "initial",
       .name = "formula",
       .type = formula,
       .meaning = "stress as a formula of x, in mu A / pi",
       .otherwise = "required by the profile formula"},
      {.table = "initial",
       .name = "file",
       .type = text,
       .meaning = "CSV or NetCDF file with x and stress; relative to the scenario file",
       .otherwise = "required by the profile table"},
      {.table = "initial",
       .name = "hold",
       .type = truth,
       .meaning = "a static load holds at rest the stress that is not in equilibrium",
       .otherwise = "false"},
  };
}

/// The keys of [friction]. Parameters of the laws come from the laws themselves.
std::vector<Key> friction_keys() {
  Key law{.table = "friction", .name = "law", .type = word, .meaning = "law of friction", .otherwise = "none"};
  for (const Definition* definition : friction::laws()) law.words.push_back(definition->name);
  std::vector<Key> all = {law};
  for (const Definition* definition : friction::laws()) {
    for (const Parameter& p : definition->parameters) {
      const auto known = std::find_if(all.begin(), all.end(), [&](const Key& key) { return key.name == p.name; });
      if (known != all.end()) {
        known->laws.push_back(definition->name);
        if (known->meaning.find(p.meaning) == std::string::npos) known->meaning += "; " + std::string(p.meaning);
        if (known->unit != p.unit && p.words.empty()) known->unit = "the unit that the law needs";
        continue;
      }
      const bool has_words = !p.words.empty();
      all.push_back(
          {.table = "friction",
           .name = p.name,
           .type = has_words ? word : number,
           .meaning = std::string(p.meaning),
           .unit = has_words ? "" : p.unit,
           .otherwise = has_words ? std::string(p.words.at(static_cast<std::size_t>(p.value))) : shortest(p.value),
           .limits = {.least = p.least, .most = p.most, .without_least = p.without_least},
           .words = p.words,
           .laws = {definition->name}});
    }
  }
  const auto add_curve = [&](Key key, friction::CurveSource source) {
    for (const Definition* definition : friction::laws())
      if (definition->curve == source) key.laws.push_back(definition->name);
    all.push_back(key);
  };
  add_curve({.table = "friction",
             .name = "formula",
             .type = formula,
             .meaning = "force as a formula of the slip velocity w, which is multiplied by coefficient",
             .otherwise = "required by the law formula"},
            friction::CurveSource::formula);
  add_curve({.table = "friction",
             .name = "file",
             .type = text,
             .meaning = "CSV or NetCDF file with w and f; relative to the scenario file",
             .otherwise = "required by the law table"},
            friction::CurveSource::table);
  all.push_back({.table = "friction",
                 .name = "closure",
                 .type = word,
                 .meaning = "average of friction: the exact one, or the printed one, which understates friction",
                 .otherwise = "consistent",
                 .words = {"consistent", "paper"}});
  all.push_back({.table = "friction",
                 .name = "normal_stress",
                 .type = quantity,
                 .meaning = "with it, numbers for forces are friction coefficients",
                 .otherwise = "forces are in the unit of F"});
  return all;
}

std::vector<Key> load_and_domain_keys() {
  return {
      {.table = "forcing",
       .name = "formula",
       .type = formula,
       .meaning = "force F(x, t) that pushes slip forward, in mu A^2 / (pi (1 - nu))",
       .otherwise = "0"},
      {.table = "loading",
       .name = "stiffness",
       .meaning = "force of the springs over their stretch; stress over stretch at a pulled end",
       .unit = "unit of F over b / (2 pi)",
       .otherwise = "required by [loading]",
       .limits = positive},
      {.table = "loading",
       .name = "velocity",
       .meaning = "velocity of the far ends of the springs",
       .unit = velocity_unit,
       .otherwise = "required by [loading]"},
      {.table = "loading",
       .name = "where",
       .type = word,
       .meaning = "sites that the springs pull",
       .otherwise = "everywhere",
       .words = {"everywhere", "left", "right"}},
      {.table = "loading",
       .name = "event_velocity",
       .meaning = "slip velocity above which a part of the chain is in an event",
       .unit = velocity_unit,
       .otherwise = "10 times velocity",
       .limits = positive},
      {.table = "interface",
       .name = "contact",
       .type = formula,
       .meaning = "contact ratio a(x) > 0 relative to A; 0 only for a chain without a substrate",
       .otherwise = "1"},
      {.table = "domain",
       .name = "left",
       .meaning = "x of the left end",
       .unit = position_unit,
       .otherwise = "chosen for a step or tanh",
       .limits = position},
      {.table = "domain",
       .name = "right",
       .meaning = "x of the right end",
       .unit = position_unit,
       .otherwise = "chosen for a step or tanh",
       .limits = position},
      {.table = "time",
       .name = "end",
       .meaning = "time at which the run ends",
       .unit = time_unit,
       .otherwise = "2 pi",
       .limits = positive},
  };
}

std::vector<Key> pulse_keys() {
  const std::vector<std::string_view> ends = {"continued", "fixed", "free"};
  return {
      {.table = "pulse",
       .name = "cells",
       .type = whole_number,
       .meaning = "number of cells over the stressed stretch",
       .unit = pure_number,
       .otherwise = "400",
       .limits = {.least = 4, .most = 10'000'000}},
      {.table = "pulse",
       .name = "tolerance",
       .meaning = "error of an implicit step",
       .unit = pure_number,
       .otherwise = "1e-06",
       .limits = tolerance},
      {.table = "pulse",
       .name = "threshold",
       .meaning = "slip velocity at which an observer sees a front, over the peak slip velocity",
       .unit = pure_number,
       .otherwise = "0.001",
       .limits = fraction},
      {.table = "pulse",
       .name = "left",
       .type = word,
       .meaning = "condition at the left end",
       .otherwise = "continued",
       .words = ends},
      {.table = "pulse",
       .name = "right",
       .type = word,
       .meaning = "condition at the right end",
       .otherwise = "continued",
       .words = ends},
      {.table = "pulse",
       .name = "periodic",
       .type = truth,
       .meaning = "a ring, which is stressed at both ends of the domain",
       .otherwise = "false"},
  };
}

std::vector<Key> chain_keys() {
  const std::vector<std::string_view> ends = {"free", "fixed", "absorbing"};
  return {
      {.table = "chain",
       .name = "scale",
       .meaning = "factor by which x and t are stretched and friction is divided",
       .unit = pure_number,
       .otherwise = "1",
       .limits = positive},
      {.table = "chain",
       .name = "spacing",
       .meaning = "spacing of the sites on the stretched chain; A on a lattice",
       .unit = position_unit,
       .otherwise = "0.4 of the width of a dislocation",
       .limits = positive},
      {.table = "chain",
       .name = "model",
       .type = word,
       .meaning = "Eq. (3), or the lattice of Eq. (1)",
       .otherwise = "sine-gordon",
       .words = {"sine-gordon", "lattice"}},
      {.table = "chain",
       .name = "left",
       .type = word,
       .meaning = "condition at the left end",
       .otherwise = "fixed",
       .words = ends},
      {.table = "chain",
       .name = "right",
       .type = word,
       .meaning = "condition at the right end",
       .otherwise = "fixed",
       .words = ends},
      {.table = "chain",
       .name = "periodic",
       .type = truth,
       .meaning = "a ring of the length of the domain",
       .otherwise = "false"},
      {.table = "chain",
       .name = "window",
       .meaning = "length of the average at x = 0",
       .unit = position_unit,
       .otherwise = "one spacing of the train",
       .limits = positive},
      {.table = "chain",
       .name = "steps",
       .type = word,
       .meaning = "time steps; always implicit with [loading]",
       .otherwise = "explicit",
       .words = {"explicit", "implicit"}},
      {.table = "chain",
       .name = "tolerance",
       .meaning = "error of an implicit step",
       .unit = pure_number,
       .otherwise = "5e-05",
       .limits = tolerance},
  };
}

std::vector<Key> medium_keys() {
  std::vector<Key> all;
  for (const medium::Constant& constant : medium::constants()) {
    const bool pure = constant.dimension == medium::Dimension::ratio;
    Key key{.table = "medium",
            .name = constant.name,
            .type = quantity,
            .meaning = std::string(constant.meaning),
            .unit = pure ? pure_number : "",
            .limits = positive};
    if (constant.name == "poisson_ratio")
      key.limits = {.least = -1, .most = 0.5, .without_least = true, .without_most = true};
    all.push_back(key);
  }
  return all;
}

std::vector<Key> output_keys() {
  return {
      {.table = "output",
       .name = "times",
       .type = numbers,
       .meaning = "increasing times at which results are written; t = 0 and the end always are",
       .unit = time_unit,
       .otherwise = "none",
       .limits = {.least = 0}},
      {.table = "output",
       .name = "every",
       .meaning = "interval between the times of results, in place of times",
       .unit = time_unit,
       .otherwise = "none",
       .limits = positive},
      {.table = "output",
       .name = "variables",
       .type = KeyType::words,
       .meaning = "variables in the output file",
       .otherwise = "all",
       .words = {"k", "Sigma", "U", "W", "H", "slip", "stress_drop"}},
  };
}

}  // namespace

bool Limits::hold(double value) const {
  return std::isfinite(value) && (without_least ? value > least : value >= least) &&
         (without_most ? value < most : value <= most);
}

std::string Limits::text() const {
  std::string text = "a finite number";
  if (std::isfinite(least)) text += (without_least ? " > " : " >= ") + shortest(least);
  if (std::isfinite(least) && std::isfinite(most)) text += " and";
  if (std::isfinite(most)) text += (without_most ? " < " : " <= ") + shortest(most);
  return text;
}

std::string_view name_of(KeyType type) {
  constexpr std::array<std::string_view, 9> names = {"number",  "whole number",  "list of numbers",
                                                     "word",    "list of words", "text",
                                                     "formula", "truth value",   "quantity"};
  return names.at(static_cast<std::size_t>(type));
}

std::string Key::allowed() const {
  std::string text;
  for (const std::string_view choice : words) text += (text.empty() ? "" : ", ") + std::string(choice);
  if (!text.empty()) return text;
  if (type == truth) return "true, false";
  const bool numeric = type == number || type == whole_number || type == numbers || type == quantity;
  if (!numeric || !(std::isfinite(limits.least) || std::isfinite(limits.most))) return "";
  return limits.text().substr(std::string_view("a finite number ").size());
}

const std::vector<Key>& keys() {
  static const std::vector<Key> all = [] {
    std::vector<Key> some = {
        {.table = "", .name = "title", .type = text, .meaning = "title of the run", .otherwise = ""}};
    for (const auto& part : {initial_keys(), friction_keys(), load_and_domain_keys(), pulse_keys(), chain_keys(),
                             medium_keys(), output_keys()})
      some.insert(some.end(), part.begin(), part.end());
    return some;
  }();
  return all;
}

std::vector<const Key*> keys_of(std::string_view table) {
  std::vector<const Key*> found;
  for (const Key& key : keys())
    if (key.table == table) found.push_back(&key);
  return found;
}

}  // namespace slipfront::scenario
