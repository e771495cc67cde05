#include "slipfront/lattice/plane/source_parameters.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

namespace {

using namespace slipfront;
using plane::MapGrid;
using plane::SeriesRow;
using std::numbers::pi;

/// The moment rate whose amplitude spectrum is M / (1 + (f / f_c)^2): an exponential on both sides of its peak.
std::vector<SeriesRow> brune(double corner, double moment, double interval) {
  std::vector<SeriesRow> series;
  const double decay = 2 * pi * corner, peak = 20 / decay;
  for (double t = 0; t < 2 * peak; t += interval) {
    const double from_peak = decay * std::fabs(t - peak);
    SeriesRow row;
    row.time = t;
    row.potency_rate = moment * decay / 2 * std::exp(-from_peak);
    row.potency = moment * (t < peak ? std::exp(-from_peak) / 2 : 1 - std::exp(-from_peak) / 2);
    series.push_back(row);
  }
  return series;
}

TEST(SourceParameters, CornerFrequencyAndSpectrumOfAnOmegaSquareSource) {
  const std::vector<SeriesRow> series = brune(0.4, 7, 0.005);
  EXPECT_NEAR(plane::corner_frequency(series), 0.4, 0.4 * 0.01);
  for (const double f : {0.01, 0.1, 0.4, 2.0})
    EXPECT_NEAR(plane::spectrum(series, {f})[0], 7 / (1 + f * f / 0.16), 0.002 * 7 / (1 + f * f / 0.16) + 1e-6);
  EXPECT_NEAR(plane::duration(series), 2 * std::log(10) / (2 * pi * 0.4), 0.01);  // e^-x / 2 = 0.05 on both sides
}

/// The spectrum at high and low frequencies, where the formulas have their limits, is that of a straight line.
TEST(SourceParameters, SpectrumIsExactForStraightLines) {
  std::vector<SeriesRow> coarse(2), fine(2001);
  coarse[0].potency_rate = fine[0].potency_rate = 1;
  coarse[1].time = 1;
  coarse[1].potency_rate = 3;
  for (std::size_t i = 0; i < fine.size(); ++i) {
    fine[i].time = static_cast<double>(i) / 2000;
    fine[i].potency_rate = 1 + 2 * fine[i].time;
  }
  for (const double f : {1e-6, 1e-3, 3.1e-3, 3.2e-3, 0.1, 1.0, 7.3})
    EXPECT_NEAR(plane::spectrum(coarse, {f})[0] / plane::spectrum(fine, {f})[0], 1, 1e-5) << f;
}

TEST(SourceParameters, NoCornerFrequencyBeforeTheSlipEnds) {
  std::vector<SeriesRow> series = brune(0.4, 7, 0.01);
  series.resize(series.size() / 2);
  EXPECT_FALSE(plane::has_ended(series));
  EXPECT_TRUE(std::isnan(plane::corner_frequency(series)));
  EXPECT_TRUE(std::isnan(plane::duration({})));
}

TEST(SourceParameters, RuptureVelocityOfACircularFront) {
  const MapGrid grid{.nx = 80, .ny = 40, .dx = 0.05, .dy = 0.1};
  std::vector<double> time(80 * 40);
  for (int j = 0; j < grid.ny; ++j)
    for (int i = 0; i < grid.nx; ++i) time[grid.at(i, j)] = std::hypot((i + 0.5) * 0.05 + 3, (j + 0.5) * 0.1) / 0.6;
  time[grid.at(10, 10)] = std::nan("");
  const std::vector<double> velocity = plane::rupture_velocity(grid, time);
  EXPECT_TRUE(std::isnan(velocity[grid.at(10, 10)]));
  for (const auto& [i, j] : {std::pair{0, 0}, {40, 20}, {79, 39}, {11, 10}})
    EXPECT_NEAR(velocity[grid.at(i, j)], 0.6, 0.01) << i << ' ' << j;
}

TEST(SourceParameters, StressDropIsWeightedBySlip) {
  EXPECT_DOUBLE_EQ(plane::stress_drop({1, 2, 5}, {0.5, 1, 5}, {1, 3, 0}), 3.5 / 4);
  EXPECT_DOUBLE_EQ(plane::stress_drop({1, 2, 5}, {0.5, 1, 5}, {-1, 3, 0}), 3.5 / 4);
  EXPECT_TRUE(std::isnan(plane::stress_drop({1}, {1}, {0})));
}

/// Lines that shrink make negative slip, which has the same source parameters as positive slip of this size.
TEST(SourceParameters, DoNotDependOnTheSignOfTheSlip) {
  std::vector<SeriesRow> positive, negative;
  for (int i = 0; i <= 200; ++i) {
    SeriesRow row;
    row.time = 0.1 * i;
    row.potency = 1 - (1 + row.time) * std::exp(-row.time);
    row.potency_rate = row.time * std::exp(-row.time);
    positive.push_back(row);
    row.potency = -row.potency, row.potency_rate = -row.potency_rate;
    negative.push_back(row);
  }
  EXPECT_GT(plane::duration(positive), 3);
  EXPECT_DOUBLE_EQ(plane::duration(negative), plane::duration(positive));
  EXPECT_GT(plane::corner_frequency(positive), 0.1);
  EXPECT_DOUBLE_EQ(plane::corner_frequency(negative), plane::corner_frequency(positive));
}

TEST(SourceParameters, RiseTimeOfAConstantVelocityIsItsDuration) {
  EXPECT_DOUBLE_EQ(plane::rise_time({3 * 0.7}, {9 * 0.7})[0], 0.7);
  EXPECT_TRUE(std::isnan(plane::rise_time({0}, {0})[0]));
}

TEST(SourceParameters, ArrestRadiusIsThatOfAFrontThatStops) {
  std::vector<SeriesRow> series;
  for (int i = 0; i <= 100; ++i) {
    SeriesRow row;
    row.time = i;
    row.front = 3 - std::exp(-i / 5.0);
    series.push_back(row);
  }
  EXPECT_NEAR(plane::arrest_radius(series), 3, 1e-6);
  series.resize(20);
  EXPECT_TRUE(std::isnan(plane::arrest_radius(series)));
  EXPECT_TRUE(std::isnan(plane::arrest_radius({})));
}

}  // namespace
