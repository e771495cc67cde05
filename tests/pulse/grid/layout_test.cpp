// Cells at t = 0.

#include "averages/pulse/grid/layout.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "slipfront/error.hpp"

namespace {

using namespace slipfront;
using pulse::Layout;
using std::numbers::pi;

double charge_of(const Layout& layout) { return std::accumulate(layout.charge.begin(), layout.charge.end(), 0.0); }

void expect_rising(const Layout& layout) {
  for (std::size_t i = 0; i + 1 < layout.faces.size(); ++i) EXPECT_LT(layout.faces[i], layout.faces[i + 1]) << i;
  ASSERT_EQ(layout.faces.size(), layout.charge.size() + 1);
}

TEST(Layout, HoldsTheIntegralOfTheStress) {
  const auto stress = [](double x) { return 0.5 + 0.3 * std::tanh(x); };
  const Layout layout = pulse::lay_cells(stress, -3, 2, 100, HUGE_VAL);
  expect_rising(layout);
  EXPECT_EQ(layout.charge.size(), 100u);
  const double integral = 0.5 * 5 + 0.3 * std::log(std::cosh(2.0) / std::cosh(3.0));
  EXPECT_NEAR(charge_of(layout) * 2 * pi, integral, 1e-12);
  EXPECT_FALSE(layout.left_free || layout.right_free);
}

TEST(Layout, PutsAFaceAtAStepOfStress) {
  const auto stress = [](double x) { return x < 0.123 ? 0.8 : 0.2; };
  const Layout layout = pulse::lay_cells(stress, -1, 1, 50, 0.123);
  EXPECT_TRUE(std::find(layout.faces.begin(), layout.faces.end(), 0.123) != layout.faces.end());
}

TEST(Layout, NarrowsCellsTowardsAFreeEdge) {
  const auto stress = [](double x) { return x < 0 ? 0.8 : 0.0; };
  const Layout layout = pulse::lay_cells(stress, -1, 1, 50, 0);
  expect_rising(layout);
  EXPECT_TRUE(layout.right_free);
  EXPECT_NEAR(layout.faces.back(), 0, 1e-12);
  const std::size_t last = layout.charge.size() - 1;
  const double at_edge = layout.faces[last + 1] - layout.faces[last], far = layout.faces[1] - layout.faces[0];
  EXPECT_LT(at_edge, far / 5);
}

TEST(Layout, GivesAGapOneCellWithoutDislocations) {
  const auto stress = [](double x) { return std::fabs(x) > 0.5 ? 0.8 : 0.0; };
  const Layout layout = pulse::lay_cells(stress, -2, 2, 60, HUGE_VAL);
  expect_rising(layout);
  EXPECT_EQ(std::count(layout.charge.begin(), layout.charge.end(), 0.0), 1);
  EXPECT_NEAR(charge_of(layout) * 2 * pi, 0.8 * 3, 1e-9);
}

TEST(Layout, RejectsAnInterfaceWithoutStress) {
  EXPECT_THROW(pulse::lay_cells([](double) { return 0.0; }, -1, 1, 50, HUGE_VAL), InputError);
}

}  // namespace
