// Runs that take far more steps than expected are given up.

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "averages/pulse/solver.hpp"
#include "math/time_steps.hpp"
#include "slipfront/averages/pulse/run.hpp"
#include "slipfront/scenario/problem.hpp"
#include "slipfront/scenario/scenario.hpp"

namespace {

using slipfront::NumericsError;
using slipfront::StepBudget;
namespace pulse = slipfront::pulse;

TEST(StepBudget, AllowsAStatedMultipleOfTheExpectedSteps) {
  const StepBudget budget(1e5, 1);
  EXPECT_EQ(budget.most(), StepBudget::most_times_expected * 1e5);
  EXPECT_FALSE(budget.exhausted(3'000'000));
  EXPECT_TRUE(budget.exhausted(3'000'001));
}

TEST(StepBudget, AlwaysAllowsSomeSteps) {
  const StepBudget budget(4, 1);
  EXPECT_FALSE(budget.exhausted(20'000));
  EXPECT_TRUE(budget.exhausted(20'001));
}

TEST(StepBudget, StatesHowFarTheRunHasCome) {
  const std::string text = StepBudget(4, 2).error(0.5, 20'001, "Reason", "help").what();
  EXPECT_EQ(text,
            "t = 0.5: given up after 20001 steps, 25 % of the run; about 4 steps were expected for all of it. Reason; "
            "help");
}

/// A tolerance that asks for steps far shorter than waves need.
pulse::Problem needlessly_exact() {
  return {.stress = [](double x) { return 0.6 - 0.1 * std::tanh(x); },
          .forcing = {},
          .friction = slipfront::friction::viscous(0.1),
          .left = -2,
          .right = 2,
          .cells = 8,
          .explicit_tolerance = 1e-24};
}

std::string end_of(pulse::Run& run) {
  try {
    run.go();
  } catch (const NumericsError& error) {
    return error.what();
  }
  return "no error";
}

TEST(StepBudget, EndsAPulseAndTellsWhereAndWhy) {
  const slipfront::output::Schedule schedule{.times = {0, 10}, .x_edges = {-2, 0, 2}};
  pulse::Run run(needlessly_exact(), schedule);
  const std::string text = end_of(run);
  EXPECT_NE(text.find("given up after 20001 steps"), std::string::npos) << text;
  EXPECT_NE(text.find("The error of a step allows steps of"), std::string::npos) << text;
  EXPECT_NE(text.find("cell "), std::string::npos) << text;
  EXPECT_NE(text.find("fewer cells"), std::string::npos) << text;
  // Steps before an interruption count too.
  pulse::Run cut(needlessly_exact(), schedule);
  cut.go([&] { return cut.solver().cells().steps == 5000; });
  pulse::Run resumed(needlessly_exact(), schedule, cut.saved(), cut.snapshots());
  EXPECT_EQ(end_of(resumed), text);
}

/// A slow pulse under a weak load. At the speed of light, waves would cross its cells 1e35 times. Each step should be
/// much longer than a friction time, although the state of friction allows no implicit steps.
TEST(StepBudget, FitsASlowPulseWithRateAndStateFriction) {
  const std::string text = R"toml([initial]
profile = "formula"
formula = "0.03057 - 0.01911*0.5*(1 - tanh((x - 2.944)/4.415)) - 0.01528*exp(-((x - 14.72)/5.887)^2)"
[friction]
law = "rate-and-state"
strength = 5.116e-71
direct_effect = 2.168e-72
evolution_effect = 6.082e-73
characteristic_slip = 0.0001957
reference_velocity = 1.007e-37
state = "slip"
[forcing]
formula = "6.673e-71*cos(1.289e-34*t + 4.86)*exp(-((x + 10.41)/8.791)^2)"
[domain]
left = -64.76
right = 64.76
[time]
end = 4.562e+34
[pulse]
cells = 50
)toml";
  const auto scenario = slipfront::scenario::read_scenario(text, "slow.toml", {}, {});
  const pulse::Problem problem = slipfront::scenario::pulse_problem(scenario);
  pulse::Run run(problem, slipfront::scenario::pulse_schedule(scenario, problem));
  EXPECT_LT(run.expected_steps(), 1000);
  EXPECT_EQ(end_of(run), "no error");
  EXPECT_LT(run.solver().cells().steps, 300);
  EXPECT_NEAR(run.snapshots().back().peak_slip_velocity, -3.94e-40,
              0.02e-40);  // from steps of 1e-8 of the run: 500,000
}

}  // namespace
