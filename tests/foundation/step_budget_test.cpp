// Runs that take far more steps than expected are given up.

#include "foundation/step_budget.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "pulse/solver.hpp"
#include "slipfront/pulse/run.hpp"

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
  EXPECT_NE(text.find("pulse.cells"), std::string::npos) << text;
  // Steps before an interruption count too.
  pulse::Run cut(needlessly_exact(), schedule);
  cut.go([&] { return cut.solver().cells().steps == 5000; });
  pulse::Run resumed(needlessly_exact(), schedule, cut.saved(), cut.snapshots());
  EXPECT_EQ(end_of(resumed), text);
}

}  // namespace
