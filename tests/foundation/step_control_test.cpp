#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "math/time_steps.hpp"

namespace {

using namespace slipfront;

const auto never = [](double, int) { return false; };

/// An integrator of third order whose error is (dt / exact)^3 tolerances.
auto third_order(double exact) {
  return [exact](double dt) { return StepAttempt{.succeeded = true, .error = std::pow(dt / exact, 3)}; };
}

TEST(StepControl, TakesAStepThatItsErrorAllows) {
  const StepControl control{.order = 3};
  for (const double first : {1e-3, 0.5, 1.0, 10.0, 1e6}) {
    const StepTaken step = take_step(control, first, third_order(1), never);
    EXPECT_LE(step.length, 1) << first;
    EXPECT_GT(step.length, 0.09 * std::fmin(first, 1)) << first;
    EXPECT_LE(step.next, 4 * step.length);
    if (first >= 0.5) {
      EXPECT_NEAR(step.next, 0.9, 1e-12) << first;
    }
  }
}

TEST(StepControl, FollowsAScaleThatShrinks) {
  const StepControl control{.order = 3};
  double t = 0, length = 0.1, steps = 0;
  while (t < 1) {
    const StepTaken step = take_step(control, length, third_order(0.2 * (1.001 - t)), never);
    EXPECT_LE(step.length, 0.2 * (1.001 - t));
    t += step.length;
    length = step.next;
    ++steps;
  }
  EXPECT_NEAR(steps, std::log(1000) / 0.2, 15);  // dt = 0.18 (1.001 - t)
}

TEST(StepControl, ShortensStepsWithoutResultOrResolution) {
  const StepControl control{.order = 4, .failure_factor = 0.25};
  std::vector<double> lengths;
  take_step(
      control, 1,
      [&](double dt) -> StepAttempt {
        lengths.push_back(dt);
        if (lengths.size() == 1) return {};
        return {.succeeded = true, .error = 0.01, .resolved = lengths.size() > 2};
      },
      never);
  EXPECT_EQ(lengths, (std::vector<double>{1, 0.25, 0.125}));
}

TEST(StepControl, DoesNotTrustAnInfiniteError) {
  const StepControl control{.order = 4};
  std::vector<double> lengths;
  take_step(
      control, 1,
      [&](double dt) -> StepAttempt {
        lengths.push_back(dt);
        return {.succeeded = true, .error = lengths.size() == 1 ? HUGE_VAL : 1};
      },
      never);
  EXPECT_EQ(lengths, (std::vector<double>{1, 0.2}));
}

TEST(StepControl, EndsWithoutAStepWhenToldTo) {
  int attempts = 0;
  const StepTaken step = take_step(
      StepControl{.order = 4}, 1, [&](double) { return StepAttempt{}; },
      [&](double, int so_far) {
        attempts = so_far;
        return so_far == 7;
      });
  EXPECT_EQ(step.length, 0);
  EXPECT_EQ(attempts, 7);
}

TEST(StepControl, LetsTheLastTwoStepsShareWhatRemains) {
  EXPECT_EQ(step_within(1, 2), 1);
  EXPECT_EQ(step_within(1, 0.9), 0.5);
  EXPECT_EQ(step_within(1, 0.4), 0.4);
}

}  // namespace
