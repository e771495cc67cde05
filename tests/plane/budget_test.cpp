#include "lattice/plane/budget.hpp"

#include <gtest/gtest.h>

#include <string>

#include "slipfront/error.hpp"

namespace slipfront::plane {
namespace {

TEST(PlaneBudget, AddsAllParts) {
  const Budget budget(
      {.kinetic = 3, .elastic = -10, .dissipated = 4, .supplied = 1, .vanished = 0.5, .radiated = 0.25});
  EXPECT_DOUBLE_EQ(budget.largest, 10);
  EXPECT_DOUBLE_EQ(budget.missing, 3.25);
  EXPECT_EQ(budget.in_words(), "32.5 % of its largest part");
}

TEST(PlaneBudget, EnergyFromNothingIsAnError) {
  const auto check = [](double kinetic) {
    check_budget({.kinetic = kinetic, .elastic = -10}, 1e-6, 2, "more lines are needed");
  };
  EXPECT_NO_THROW(check(10.9));
  EXPECT_NO_THROW(check(1));  // a loss is not an error
  try {
    check(13);
    FAIL();
  } catch (const NumericsError& error) {
    EXPECT_EQ(std::string(error.what()),
              "t = 2: the energy exceeds what was released by 23.1 % of its largest part; more lines are needed");
  }
  EXPECT_NO_THROW(check_budget({.kinetic = 1e-7, .elastic = 0}, 1e-6, 0, ""));  // rounding errors at rest
}

}  // namespace
}  // namespace slipfront::plane
