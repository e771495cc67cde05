#include "math/roots.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace {

using namespace slipfront;

TEST(Bracket, FindsRootsToTheResolutionOfADouble) {
  for (const double root : {1e-300, 1e-9, 0.7, 3e5, 1e150})
    for (const double power : {0.2, 1.0, 5.0}) {
      const auto f = [=](double x) { return std::pow(x / root, power) - 1; };
      EXPECT_NEAR(root_in_bracket(root / 1e3, root * 1e4, f) / root, 1, 1e-15) << root << " " << power;
    }
}

TEST(Bracket, FindsRootsOfFunctionsWhoseValuesAreTiny) {
  EXPECT_NEAR(root_in_bracket(1e-200, 1e-190, [](double x) { return 1e-100 * (x - 3e-195); }) / 3e-195, 1, 1e-15);
}

TEST(Bracket, EndsWhereTheFunctionIsInfinite) {
  const double infinity = std::numeric_limits<double>::infinity();
  EXPECT_NEAR(root_in_bracket(1, 3, [=](double x) { return x > 2.5 ? infinity : x - 2; }), 2, 1e-15);
  EXPECT_NEAR(root_in_bracket(1, 3, [=](double x) { return x > 2 ? infinity : -1; }), 2, 1e-15);
}

/// Without the halved weight one end of a convex function would stay for ever, and the error fall by a factor a step.
TEST(Bracket, ConvergesFasterThanLinearlyWhereTheFunctionIsConvex) {
  const auto f = [](double x) { return std::expm1(8 * x) - 1; };
  Bracket root{.low = 0, .high = 1, .at_low = f(0), .at_high = f(1)};
  int calls = 0;
  for (root.aim(); std::fabs(f(root.x)) > 1e-13 && calls < 100; root.aim(), ++calls) root.take(f(root.x));
  EXPECT_NEAR(root.x, std::log(2) / 8, 1e-14);
  EXPECT_LT(calls, 25);
}

}  // namespace
