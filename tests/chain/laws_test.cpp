// Every law that a scenario can name must give the same slip for the same problem on a pulse and on chains of two
// scales. The test covers each law that is added to friction::laws(), without a change here.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "law_values.hpp"
#include "runs/compare.hpp"
#include "slipfront/scenario/problem.hpp"

namespace slipfront {
namespace {

using friction::CurveSource;
using friction::Definition;
using friction::Parameter;

constexpr double small_scale = 100, large_scale = 300;

std::vector<std::vector<double>> curve_table(const std::string&, const std::vector<std::string>&) {
  return {{0, 0}, {0.02, 0.1}, {0.1, 0.3}, {1, 0.9}, {100, 1}};
}

/// A step of stress next to the empty side, under a law whose forces have the size `force`.
scenario::Scenario step_under(const Definition& law, std::size_t word, double force) {
  std::string text = "[initial]\nstress_left = 0.855\nstress_right = 0\n[pulse]\ncells = 60\n[friction]\nlaw = \"" +
                     std::string(law.name) + "\"\n";
  if (law.curve == CurveSource::formula) text += "formula = \"w / (0.2 + w)\"\n";
  if (law.curve == CurveSource::table) text += "file = \"curve.csv\"\n";
  const std::vector<double> values =
      friction::law_values(law, word, {.force = force, .slip = 0.1, .time = 0.7, .velocity = 0.05});
  for (std::size_t i = 0; i < values.size(); ++i) {
    const Parameter& p = law.parameters[i];
    if (p.only_on_chain) continue;
    const std::string value = p.words.empty()
                                  ? std::to_string(values[i])
                                  : '"' + std::string(p.words.at(static_cast<std::size_t>(values[i]))) + '"';
    text += std::string(p.name) + " = " + value + "\n";
  }
  return scenario::read_scenario(text, "law.toml", {}, curve_table);
}

double slip_of_pulse(const scenario::Scenario& s) {
  const pulse::Problem problem = scenario::pulse_problem(s);
  pulse::Run run(problem, scenario::pulse_schedule(s, problem));
  run.go({});
  return run.snapshots().back().slip_at_origin;
}

/// The size of forces under which a pulse slips half as far as without friction.
double force_that_halves_slip(const Definition& law, std::size_t word) {
  double low = 1e-3, high = 10;
  const double half = slip_of_pulse(step_under(*friction::laws().front(), 0, 0)) / 2;
  for (int i = 0; i < 12; ++i) {
    const double middle = std::sqrt(low * high);
    (slip_of_pulse(step_under(law, word, middle)) > half ? low : high) = middle;
  }
  EXPECT_GT(low, 1e-3) << law.name;
  EXPECT_LT(high, 10) << law.name;
  return low;
}

double slip_of(const std::vector<run::ComparedModel>& levels, std::string_view name) {
  for (const run::ComparedModel& level : levels)
    if (level.name == name) return level.snapshots.back().slip_at_origin;
  ADD_FAILURE() << "no level " << name;
  return 0;
}

TEST(Laws, SlipEquallyOnThePulseAndOnChainsOfTwoScales) {
  for (const Definition* law : friction::laws())
    for (std::size_t word = 0; !law->parameters.empty() && word < friction::law_words(*law); ++word) {
      SCOPED_TRACE(std::string(law->name) + ", word " + std::to_string(word));
      const scenario::Scenario s = step_under(*law, word, force_that_halves_slip(*law, word));
      std::vector<run::ComparedModel> levels;
      run::compare(
          run::comparison_of(s, {small_scale, large_scale}), {}, {}, 1, levels, [] {},
          [](const std::string&, double, long) { return false; });
      // The position of the last dislocation that passed adds up to half a dislocation to the slip of a chain.
      const double pulse = slip_of(levels, "pulse-consistent"), share_of_dislocation = 0.3 * 2 * std::numbers::pi;
      EXPECT_NEAR(slip_of(levels, "chain-100"), pulse, share_of_dislocation / small_scale);
      EXPECT_NEAR(slip_of(levels, "chain-300"), pulse, share_of_dislocation / large_scale);
    }
}

}  // namespace
}  // namespace slipfront
