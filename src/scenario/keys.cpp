#include "slipfront/scenario/keys.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "math/digits.hpp"
#include "slipfront/friction/friction.hpp"
#include "slipfront/scenario/scenario.hpp"
#include "slipfront/theory/medium/constants.hpp"

namespace slipfront::scenario {
namespace {

using friction::Definition;
using friction::Parameter;

constexpr Limits above_zero{.least = 0, .without_least = true};
constexpr Limits position_limits{.least = -farthest, .most = farthest};
constexpr Limits stress_limits{.least = 0, .most = largest_stress};
constexpr Limits fraction_limits{.least = 0, .most = 1, .without_least = true, .without_most = true};
constexpr Limits tolerance_limits{.least = 1e-12, .most = 0.1};

/// A key whose value is a number.
Key number_key(std::string_view table, std::string_view name, ModelUnit unit, Limits limits, std::string otherwise,
               std::string meaning) {
  return {.table = table,
          .name = name,
          .meaning = std::move(meaning),
          .unit = symbol_of(unit),
          .scale = unit,
          .otherwise = std::move(otherwise),
          .limits = limits};
}

/// A key whose value is one of a few words.
Key word_key(std::string_view table, std::string_view name, std::vector<std::string_view> words, std::string otherwise,
             std::string meaning) {
  return {.table = table,
          .name = name,
          .type = KeyType::word,
          .meaning = std::move(meaning),
          .otherwise = std::move(otherwise),
          .words = std::move(words)};
}

/// A key of another type: a formula, a text, a truth value.
Key other_key(std::string_view table, std::string_view name, KeyType type, std::string otherwise, std::string meaning) {
  return {.table = table, .name = name, .type = type, .meaning = std::move(meaning), .otherwise = std::move(otherwise)};
}

Key formula_key(std::string_view table, std::string_view name, ModelUnit unit, std::string otherwise,
                std::string meaning) {
  Key key = other_key(table, name, KeyType::formula, std::move(otherwise), std::move(meaning));
  key.scale = unit;
  return key;
}

Key units_key(std::string_view table, const std::string& what) {
  return word_key(table, "units", {"model", "SI"}, "model",
                  "units of " + what + ": those of the model, or m, s and Pa");
}

std::vector<Key> initial_keys() {
  const std::string_view table = "initial";
  const std::string step_or_tanh = "required by step and tanh";
  const Limits widths{.least = 0, .most = farthest, .without_least = true};
  return {
      word_key(table, "profile", {"step", "tanh", "formula", "table", "radial", "grid"}, "step",
               "form of the initial stress; of the initial slip on a plane: formula, radial or grid"),
      number_key(table, "stress_left", ModelUnit::stress, stress_limits, step_or_tanh,
                 "stress of a step or tanh at x < 0; 0 is an empty interface"),
      number_key(table, "stress_right", ModelUnit::stress, stress_limits, step_or_tanh,
                 "stress of a step or tanh at x > 0; 0 is an empty interface"),
      number_key(table, "width", ModelUnit::position, widths, "1",
                 "width of a tanh: right + (left - right)(1 - tanh(x / width)) / 2"),
      formula_key(table, "formula", ModelUnit::stress, "required by the profile formula",
                  "stress as a formula of x, in mu A / pi; on a plane slip as a formula of x and y, in b / (2 pi)"),
      units_key(table, "formula or the columns of file"),
      other_key(table, "file", KeyType::text, "required by the profiles table and radial",
                "CSV or NetCDF file with x and stress, or with r and slip; relative to the scenario file"),
      other_key(table, "hold", KeyType::truth, "false",
                "a static load holds at rest the stress that is not in equilibrium"),
  };
}

Key key_of(const Parameter& p) {
  const bool has_words = !p.words.empty();
  return {.table = "friction",
          .name = p.name,
          .type = has_words ? KeyType::word : KeyType::number,
          .meaning = std::string(p.meaning),
          .unit = has_words ? "" : p.unit,
          .otherwise = has_words ? std::string(p.words.at(static_cast<std::size_t>(p.value))) : shortest(p.value),
          .limits = {.least = p.least, .most = p.most, .without_least = p.without_least},
          .words = p.words};
}

/// Parameters of the laws, each once. A parameter of several laws has the meanings that it has in each.
std::vector<Key> parameter_keys() {
  std::vector<Key> all;
  for (const Definition* law : friction::laws()) {
    for (const Parameter& p : law->parameters) {
      auto known = std::find_if(all.begin(), all.end(), [&](const Key& key) { return key.name == p.name; });
      if (known == all.end()) {
        all.push_back(key_of(p));
        known = all.end() - 1;
      }
      known->laws.push_back(law->name);
      if (known->meaning.find(p.meaning) == std::string::npos) known->meaning += "; " + std::string(p.meaning);
      if (known->unit != p.unit && p.words.empty()) known->unit = "the unit that the law needs";
    }
  }
  return all;
}

/// Adds the laws that take their curve from this source.
Key with_laws(Key key, friction::CurveSource source) {
  for (const Definition* law : friction::laws())
    if (law->curve == source) key.laws.push_back(law->name);
  return key;
}

std::vector<Key> friction_keys() {
  const std::string_view table = "friction";
  std::vector<std::string_view> names;
  for (const Definition* law : friction::laws()) names.push_back(law->name);
  std::vector<Key> all = {word_key(table, "law", names, "none", "law of friction")};
  const std::vector<Key> parameters = parameter_keys();
  all.insert(all.end(), parameters.begin(), parameters.end());
  all.push_back(with_laws(other_key(table, "formula", KeyType::formula, "required by the law formula",
                                    "force as a formula of the slip velocity w, which is multiplied by coefficient"),
                          friction::CurveSource::formula));
  all.push_back(with_laws(other_key(table, "file", KeyType::text, "required by the law table",
                                    "CSV or NetCDF file with w and f; relative to the scenario file"),
                          friction::CurveSource::table));
  all.push_back(word_key(
      table, "units", {"model", "SI"}, "model",
      "units of formulas and files, also of those in place of a number that varies: those of the model, or m, s, "
      "m/s and Pa; f is a pure number if coefficient is a stress"));
  all.push_back(word_key(table, "closure", {"consistent", "paper"}, "consistent",
                         "average of friction: the exact one, or the printed one, which understates friction"));
  all.push_back(
      other_key(table, "normal_stress", KeyType::quantity, "forces are in the unit of F",
                "with it, numbers for forces are friction coefficients. It and the numbers of a law may vary: a "
                "formula of x (and y on a plane), or { file = \"a.csv\", column = \"a\" }"));
  return all;
}

std::vector<Key> load_keys() {
  return {
      formula_key("forcing", "formula", ModelUnit::force, "0",
                  "force F(x, t) that pushes slip forward, in mu A^2 / (pi (1 - nu))"),
      units_key("forcing", "x, t and formula"),
      number_key("loading", "stiffness", ModelUnit::stiffness, above_zero, "required by [loading]",
                 "force of the springs over their stretch; stress over stretch at a pulled end"),
      other_key("loading", "area", KeyType::quantity, "none", "area that the springs pull, for a stiffness in N/m"),
      number_key("loading", "velocity", ModelUnit::slip_velocity, {}, "required by [loading]",
                 "velocity of the far ends of the springs"),
      word_key(
          "loading", "units", {"model", "SI"}, "model",
          "units of formulas and files in place of stiffness and velocity, which may vary as numbers of [friction]"),
      word_key("loading", "where", {"everywhere", "left", "right"}, "everywhere", "sites that the springs pull"),
      number_key("loading", "event_velocity", ModelUnit::slip_velocity, above_zero, "10 times velocity",
                 "slip velocity above which a part of the chain is in an event"),
      other_key("interface", "contact", KeyType::formula, "1",
                "contact ratio a(x) > 0 relative to A; 0 only for a chain without a substrate"),
      units_key("interface", "x"),
  };
}

std::vector<Key> domain_and_time_keys() {
  const std::string found = "chosen for a step or tanh";
  return {
      number_key("domain", "left", ModelUnit::position, position_limits, found, "x of the left end"),
      number_key("domain", "right", ModelUnit::position, position_limits, found, "x of the right end"),
      number_key("time", "end", ModelUnit::time, above_zero, "2 pi", "time at which the run ends"),
  };
}

std::vector<Key> plane_keys() {
  const std::string_view table = "plane";
  const auto count = [&](std::string_view name, Limits limits, std::string otherwise, std::string meaning) {
    Key key = number_key(table, name, ModelUnit::none, limits, std::move(otherwise), std::move(meaning));
    key.type = KeyType::whole_number;
    return key;
  };
  return {
      number_key(table, "left", ModelUnit::position, position_limits, "required by [plane]", "x of the left edge"),
      number_key(table, "right", ModelUnit::position, position_limits, "required by [plane]", "x of the right edge"),
      number_key(table, "bottom", ModelUnit::position, position_limits, "required by [plane]", "y of the lower edge"),
      number_key(table, "top", ModelUnit::position, position_limits, "required by [plane]", "y of the upper edge"),
      word_key(table, "solver", {"loops", "grid"}, "loops",
               "averages follow star-shaped lines, or the mean slip on a grid of cells"),
      count("cells", {.least = 8, .most = 10'000}, "200", "cells along x into which the plane is divided"),
      count("loops", {.least = 4, .most = 10'000}, "120", "cells of the averaged solver across the lines"),
      count("angles", {.least = 8, .most = 10'000}, "128", "directions of the averaged solver around the origin"),
      other_key(table, "fixed", KeyType::formula, "nowhere",
                "the interface is held where this formula of x and y is not 0"),
      units_key(table, "x and y in fixed"),
      number_key(table, "wave_speed_ratio", ModelUnit::none, above_zero, "1",
                 "speed of waves along y over that along x, the direction of slip"),
      word_key(table, "edges", {"free", "fixed", "absorbing"}, "free",
               "edges of the plane with --direct: no stress, no slip, or waves leave"),
      number_key("nucleation", "x", ModelUnit::position, position_limits, "0", "x of the middle of the patch"),
      number_key("nucleation", "y", ModelUnit::position, position_limits, "0", "y of the middle of the patch"),
      number_key("nucleation", "radius", ModelUnit::position, above_zero, "required by [nucleation]",
                 "radius of the patch in which nothing holds the initial state any more"),
      number_key("nucleation", "time", ModelUnit::time, {.least = 0}, "0", "time from which that is so"),
  };
}

std::vector<Key> pulse_keys() {
  const std::string_view table = "pulse";
  const std::vector<std::string_view> ends = {"continued", "fixed", "free"};
  Key cells = number_key(table, "cells", ModelUnit::none, {.least = 4, .most = 10'000'000}, "400",
                         "number of cells over the stressed stretch");
  cells.type = KeyType::whole_number;
  return {
      cells,
      number_key(table, "tolerance", ModelUnit::none, tolerance_limits, "1e-06", "error of an implicit step"),
      number_key(table, "threshold", ModelUnit::none, fraction_limits, "0.001",
                 "slip velocity at which an observer sees a front, over the peak slip velocity"),
      word_key(table, "left", ends, "continued", "condition at the left end"),
      word_key(table, "right", ends, "continued", "condition at the right end"),
      other_key(table, "periodic", KeyType::truth, "false", "a ring, which is stressed at both ends of the domain"),
      word_key(
          table, "trains", {"one", "many"}, "one",
          "trains at one position: one, with shocks, or as many as overtake each other (viscous friction or none)"),
  };
}

std::vector<Key> chain_keys() {
  const std::string_view table = "chain";
  const std::vector<std::string_view> ends = {"free", "fixed", "absorbing"};
  return {
      number_key(table, "scale", ModelUnit::none, above_zero, "1",
                 "factor by which x and t are stretched and friction is divided"),
      number_key(table, "spacing", ModelUnit::position, above_zero, "0.4 of the width of a dislocation",
                 "spacing of the sites on the stretched chain; A on a lattice"),
      word_key(table, "model", {"sine-gordon", "lattice"}, "sine-gordon", "Eq. 3, or the lattice of Eq. 1"),
      word_key(table, "left", ends, "fixed", "condition at the left end"),
      word_key(table, "right", ends, "fixed", "condition at the right end"),
      other_key(table, "periodic", KeyType::truth, "false", "a ring of the length of the domain"),
      number_key(table, "window", ModelUnit::position, above_zero, "one spacing of the train",
                 "length of the average at x = 0"),
      word_key(table, "steps", {"explicit", "implicit"}, "explicit", "time steps; always implicit with [loading]"),
      number_key(table, "tolerance", ModelUnit::none, tolerance_limits, "5e-05", "error of an implicit step"),
      word_key(table, "precision", {"double", "single"}, "double",
               "of explicit steps; single: faster, without friction or with viscous friction only"),
  };
}

std::vector<Key> medium_keys() {
  std::vector<Key> all;
  for (const medium::Constant& constant : medium::constants()) {
    const bool poisson = constant.name == "poisson_ratio";
    const Limits ratios{.least = -1, .most = 0.5, .without_least = true, .without_most = true};
    Key key = number_key("medium", constant.name, ModelUnit::none, poisson ? ratios : above_zero, "",
                         std::string(constant.meaning));
    if (constant.dimension != medium::Dimension::ratio) key.unit = {};
    key.type = KeyType::quantity;
    all.push_back(key);
  }
  return all;
}

std::vector<Key> output_keys() {
  Key times = number_key("output", "times", ModelUnit::time, {.least = 0}, "none",
                         "increasing times at which results are written; t = 0 and the end always are");
  times.type = KeyType::numbers;
  Key variables = word_key("output", "variables", {"k", "Sigma", "U", "W", "H", "slip", "stress_drop", "trains"}, "all",
                           "variables in the output file");
  variables.type = KeyType::words;
  Key per_event = number_key("output", "per_event", ModelUnit::none, {.least = 0, .most = 10'000}, "0",
                             "further results of each slip event, at least as many if it has that many steps");
  per_event.type = KeyType::whole_number;
  Key fronts = number_key("output", "fronts", ModelUnit::none, {.least = 3, .most = 10000}, "none",
                          "positions at which a loaded chain records the arrival of each slip event");
  fronts.type = KeyType::whole_number;
  Key probes = other_key("output", "probes", KeyType::points, "none",
                         "points of a plane at which slip and slip velocity are printed");
  probes.scale = ModelUnit::position;
  const Key lines =
      other_key("output", "lines", KeyType::truth, "false",
                "whether the file of a plane has the rupture front or, with --direct, all dislocation lines");
  return {
      times,
      number_key("output", "every", ModelUnit::time, above_zero, "none",
                 "interval between the times of results, in place of times"),
      per_event,
      variables,
      fronts,
      other_key("output", "displacement", KeyType::truth, "false", "whether the file of a chain has u at every site"),
      other_key("output", "dislocations", KeyType::truth, "false", "whether the file of a chain has every dislocation"),
      probes,
      lines};
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

std::string_view symbol_of(ModelUnit unit) {
  constexpr std::array<std::string_view, 9> symbols = {"1",
                                                       "b / A",
                                                       "b / (c A)",
                                                       "mu A / pi",
                                                       "c A / pi",
                                                       friction::force_unit,
                                                       "b / pi",
                                                       "unit of F over b / (2 pi)",
                                                       "mu A / pi over b / (2 pi)"};
  return symbols.at(static_cast<std::size_t>(unit));
}

std::string_view name_of(KeyType type) {
  constexpr std::array<std::string_view, 10> names = {
      "number", "whole number", "list of numbers", "word",     "list of words",
      "text",   "formula",      "truth value",     "quantity", "list of points"};
  return names.at(static_cast<std::size_t>(type));
}

std::string Key::allowed() const {
  std::string text;
  for (const std::string_view choice : words) text += (text.empty() ? "" : ", ") + std::string(choice);
  if (!text.empty()) return text;
  if (type == KeyType::truth) return "true, false";
  const bool numeric =
      type == KeyType::number || type == KeyType::whole_number || type == KeyType::numbers || type == KeyType::quantity;
  if (!numeric || !(std::isfinite(limits.least) || std::isfinite(limits.most))) return "";
  return limits.text().substr(std::string_view("a finite number ").size());
}

const std::vector<Key>& keys() {
  static const std::vector<Key> all = [] {
    std::vector<Key> some = {
        {.table = "", .name = "title", .type = KeyType::text, .meaning = "title of the run", .otherwise = ""}};
    for (const auto& part : {initial_keys(), friction_keys(), load_keys(), domain_and_time_keys(), plane_keys(),
                             pulse_keys(), chain_keys(), medium_keys(), output_keys()})
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
