#include "events/catalogue/population.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "slipfront/theory/rupture/relations.hpp"

namespace {

using namespace slipfront;
using namespace slipfront::catalogue;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

Member member(double V, double value) { return {V, std::vector<double>(3, value)}; }

TEST(Population, AssignsTheEndsOfDecades) {
  for (int k = -300; k < 0; ++k) {
    const double edge = std::pow(10.0, k);
    Population population;
    population.add(member(edge, 1));
    population.add(member(std::nextafter(edge, 0), 1));
    const auto decades = population.decades();
    ASSERT_EQ(decades.size(), 2u) << k;
    EXPECT_EQ(decades[0].exponent, k - 1);
    EXPECT_EQ(decades[1].exponent, k);
    EXPECT_EQ(decades[1].low, edge);
  }
}

TEST(Population, ListsEmptyDecadesAndTheClosedForm) {
  Population population;
  population.add(member(2e-6, 1));
  population.add(member(0.5, nan));
  const auto decades = population.decades();
  ASSERT_EQ(decades.size(), 6u);
  EXPECT_EQ(decades[0].events, 1u);
  EXPECT_EQ(decades[0].spread[0].of.low, 1);
  EXPECT_EQ(decades[0].spread[0].of.high, 1);
  for (std::size_t i = 1; i < 5; ++i) EXPECT_EQ(decades[i].events, 0u);
  EXPECT_EQ(decades[5].events, 1u);
  EXPECT_EQ(decades[5].spread[0].events, 0u);
  EXPECT_TRUE(std::isnan(decades[5].spread[0].of.median));
  for (const Decade& d : decades) {
    EXPECT_NEAR(d.middle, std::sqrt(d.low * d.high), 1e-14 * d.middle);
    EXPECT_EQ(d.stress, rupture::from_rupture_velocity(d.middle).stress);
  }
  const auto line = line_through(decades);
  ASSERT_EQ(line.size(), 121u);
  EXPECT_NEAR(line.front().rupture_velocity, 1e-6, 1e-18);
  EXPECT_EQ(line.back().rupture_velocity, 0.99);
  for (std::size_t i = 1; i < line.size(); ++i) EXPECT_GT(line[i].stress, line[i - 1].stress);
  EXPECT_TRUE(line_through({}).empty());
}

TEST(Population, InterpolatesQuantilesLinearly) {
  Population population;
  for (const double value : {5.0, 1.0, nan, 3.0, 2.0, 4.0}) population.add(member(0.2, value));
  const Spread s = population.decades().front().spread.front();
  EXPECT_EQ(s.events, 5u);
  EXPECT_DOUBLE_EQ(s.of.low, 1.2);
  EXPECT_DOUBLE_EQ(s.of.median, 3);
  EXPECT_DOUBLE_EQ(s.of.high, 4.8);
}

}  // namespace
