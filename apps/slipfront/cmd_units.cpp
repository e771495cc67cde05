#include <fmt/format.h>

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "batch.hpp"
#include "json.hpp"
#include "long_run.hpp"
#include "runs/run.hpp"
#include "runs/tables.hpp"
#include "slipfront/scenario/keys.hpp"
#include "slipfront/scenario/problem.hpp"
#include "slipfront/scenario/quantities.hpp"
#include "terminal_table.hpp"
#include "text/characters.hpp"

namespace {

using namespace slipfront;

std::string number(double x) { return fmt::format("{:.6g}", x); }

struct NamedNumber {
  const char *key, *meaning;
  std::string_view unit, si_unit;
  std::optional<double> value;
  std::optional<scenario::Range> range = {};
};

std::vector<NamedNumber> named(const scenario::Numbers& n) {
  using scenario::ModelUnit;
  return {{"least_stable_position", "least stable position", scenario::symbol_of(ModelUnit::position), "m", n.position},
          {"least_stable_y", "its y", scenario::symbol_of(ModelUnit::position), "m", n.position_y},
          {"strength_over_direct_effect", "f_0 / a", "", "", n.strength_over_direct_effect,
           n.strength_over_direct_effect_range},
          {"critical_stiffness", "critical stiffness", scenario::symbol_of(ModelUnit::stiffness), "Pa/m",
           n.critical_stiffness},
          {"stiffness_ratio", "stiffness over the critical one", "", "", n.stiffness_ratio, n.stiffness_ratio_range},
          {"nucleation_length", "nucleation length", scenario::symbol_of(ModelUnit::position), "m", n.nucleation_length,
           n.nucleation_length_range},
          {"length", "length of the domain", scenario::symbol_of(ModelUnit::position), "m", n.length},
          {"dislocations", "dislocations at t = 0", "", "", n.dislocations}};
}

/// The value of a unit of the model in SI units, if [medium] determines it.
std::optional<double> unit_in_si(const scenario::Scenario& s, std::string_view symbol) {
  for (const scenario::Scale& scale : scenario::scales_of(s.medium))
    if (scale.symbol == symbol) return scale.si;
  return std::nullopt;
}

/// A number in the model's unit, and in SI units if [medium] determines it.
std::string in_both(const scenario::Scenario& s, double value, std::string_view unit, std::string_view si_unit) {
  const auto si = unit_in_si(s, unit);
  return number(value) + (unit.empty() ? "" : fmt::format(" in {}", unit)) +
         (si ? fmt::format(", {} {}", number(value * *si), si_unit) : "");
}

/// One line for the least or the largest value of a number, and where it is.
std::string line_of(const scenario::Scenario& s, const NamedNumber& n, const char* which, const scenario::ValueAt& v) {
  const std::string_view length = scenario::symbol_of(scenario::ModelUnit::position);
  const auto metres = unit_in_si(s, length);
  const auto position = [&](double x) { return number(x * metres.value_or(1)); };
  return fmt::format("{}, {}: {}, at x = {}{} {}", n.meaning, which, in_both(s, v.value, n.unit, n.si_unit),
                     position(v.x), s.plane ? ", y = " + position(v.y) : "", metres ? "m" : length);
}

/// Sites, memory and disk space of a chain run of the scenario, or the reason why it has none.
std::string cost_of(const scenario::Scenario& s) {
  if (s.plane) return "a rupture on a plane: slipfront plane --check";
  try {
    const run::Plan plan = run::plan_of(scenario::SolverKind::chain, s);
    const chain::Problem p = chain::problem_of(plan.chain);
    return fmt::format("a chain of {} sites, {}", p.grid.sites, scenario::in_words(plan.need));
  } catch (const InputError& error) {
    return std::string("no chain: ") + error.complaint().problem;
  }
}

void print(const scenario::Scenario& s, const std::vector<scenario::Quantity>& quantities,
           const scenario::Numbers& numbers) {
  const std::vector<TableColumn> columns = {{32, true}, {14, true, 2}, {20, true, 1}, {37, true, 1}};
  TerminalTable table(columns);
  const auto with_unit = [](double x, std::string_view unit) {
    const std::string value = number(x);
    return fmt::format("{:>{}} {}", value, 12, unit);
  };
  const auto in_si = [&](const std::optional<double>& x, std::string_view unit) {
    return x ? with_unit(*x, unit) : fmt::format("{:>12}", "-");
  };
  table.add({"unit of the model", "", fmt::format("{:>12}", "in SI"), fmt::format("{:>12}", "in the model")});
  for (const scenario::Scale& scale : scenario::scales_of(s.medium))
    table.add({std::string(scale.name), "", in_si(scale.si, scale.si_unit), with_unit(1, scale.symbol)});
  table.add_title("");
  table.add({"key", "in the file", fmt::format("{:>12}", "in SI"), fmt::format("{:>12}", "in the model")});
  for (const scenario::Quantity& q : quantities)
    table.add({q.key, printable(q.text, 24), q.si_unit.empty() ? std::string() : in_si(q.si, q.si_unit),
               with_unit(q.model, q.unit)});
  put(table.text() + "\n");
  for (const NamedNumber& n : named(numbers)) {
    if (!n.value) continue;
    put(fitted(fmt::format("{}: {}", n.meaning, in_both(s, *n.value, n.unit, n.si_unit))));
  }
  for (const NamedNumber& n : named(numbers)) {
    if (!n.range) continue;
    put(fitted(line_of(s, n, "least", n.range->least)));
    put(fitted(line_of(s, n, "largest", n.range->largest)));
  }
  put(fitted("cost: " + cost_of(s)) + "\n");
}

Json json_of_units(const scenario::Scenario& s, const std::vector<scenario::Quantity>& quantities,
                   const scenario::Numbers& numbers) {
  Json all;
  for (const scenario::Scale& scale : scenario::scales_of(s.medium))
    all["units"].push_back(
        {{"name", scale.name}, {"symbol", scale.symbol}, {"si", ::json_of(scale.si)}, {"si_unit", scale.si_unit}});
  all["keys"] = Json::array();
  for (const scenario::Quantity& q : quantities)
    all["keys"].push_back({{"key", q.key},
                           {"text", q.text},
                           {"model", q.model},
                           {"unit", q.unit},
                           {"si", ::json_of(q.si)},
                           {"si_unit", q.si_unit}});
  for (const NamedNumber& n : named(numbers)) all["numbers"][n.key] = ::json_of(n.value);
  all["ranges"] = Json::object();
  for (const NamedNumber& n : named(numbers)) {
    if (!n.range) continue;
    for (const auto& [which, at] : {std::pair{"least", n.range->least}, {"largest", n.range->largest}}) {
      all["ranges"][n.key][which] = {{"value", at.value}, {"x", at.x}};
      if (s.plane) all["ranges"][n.key][which]["y"] = at.y;
    }
  }
  all["cost"] = cost_of(s);
  return all;
}

int run_units(const ScenarioArguments& a) {
  const scenario::Scenario s = read_scenario_of(a);
  const auto quantities = scenario::quantities_of(s.text, s.file, {}, run::read_table);
  const scenario::Numbers numbers = scenario::numbers_of(s);
  if (a.common.json)
    put(text_of(json_of_units(s, quantities, numbers)) + "\n");
  else
    print(s, quantities, numbers);
  return exit_done;
}

}  // namespace

Runner add_units(CommandLine& program) {
  auto a = std::make_shared<ScenarioArguments>();
  CommandLine command = program.command(
      "units",
      "The numbers of a scenario in the units of the model and in SI units, and those that decide its behaviour",
      {"slipfront units cases/rate-and-state.toml",
       "slipfront units cases/stick-slip.toml --set medium.contact_ratio=0.01"});
  add_scenario_words(command, *a);
  add_common_options(command, a->common, false);
  return [a] { return run_units(*a); };
}
