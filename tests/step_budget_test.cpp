// Runs that take far more steps than expected are given up.

#include "slipfront/step_budget.hpp"

#include <gtest/gtest.h>

#include <string>

namespace {

using slipfront::StepBudget;

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

}  // namespace
