#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "lattice/chain/explicit/forces.hpp"
#include "slipfront/error.hpp"

namespace {

using slipfront::InputError;
using slipfront::Ranks;
using slipfront::chain::ForcingInTime;

using Forcing = std::function<double(double x, double t)>;

constexpr double step = 0.25;

std::vector<double> positions() {
  std::vector<double> x;
  for (int j = 0; j < 500; ++j) x.push_back(0.3 * j);
  return x;
}

/// The largest difference from the formula over many levels, and the calls of the formula per site and level.
struct Compared {
  double error, calls;
};

Compared compared(const Forcing& forcing) {
  constexpr long levels = 3000;
  long calls = 0;
  const std::vector<double> x = positions();
  ForcingInTime in_time(
      [&](double at, double t) {
        ++calls;
        return forcing(at, t);
      },
      x, step);
  Compared result{0, 0};
  for (long level = 0; level < levels; ++level) {
    in_time.at(level, Ranks::single());
    for (std::size_t j = 0; j < x.size(); ++j)
      for (long after = level == 0 ? 0 : -1; after <= static_cast<long>(in_time.reach()) && level + after < levels;
           ++after)
        result.error = std::fmax(
            result.error, std::fabs(in_time(j, after) - forcing(x[j], static_cast<double>(level + after) * step)));
  }
  result.calls = static_cast<double>(calls) / (static_cast<double>(x.size()) * levels);
  return result;
}

TEST(ForcingInTime, CallsASmoothFormulaRarely) {
  const Compared slow = compared([](double x, double t) { return 0.02 * std::sin(0.01 * (x - 0.5 * t)); });
  EXPECT_LT(slow.error, 3e-15);
  EXPECT_LT(slow.calls, 0.1);
}

/// A short and narrow force between the times of a polynomial is not lost.
TEST(ForcingInTime, FollowsWhatIsNotSmooth) {
  const Compared spike = compared([](double x, double t) {
    return 0.01 + 0.3 * std::exp(-std::pow((t - 333) / 2, 2) - std::pow((x - 40) / 8, 2));
  });
  EXPECT_LT(spike.error, 1e-12);
  const Compared jump = compared([](double x, double t) { return t < 100.1 ? 0.01 : 0.02 + 1e-3 * x; });
  EXPECT_LT(jump.error, 1e-12);
  const Compared fast = compared([](double x, double t) { return std::sin(x + 2 * t); });
  EXPECT_EQ(fast.error, 0);
}

TEST(ForcingInTime, NeedsNoValuesAfterTheEnd) {
  const Compared ends = compared([](double, double t) {
    if (t > 751) throw InputError({.key = "formula", .problem = "is no number"});
    return std::sqrt(751 - t);
  });
  EXPECT_LT(ends.error, 1e-11);
}

/// A resumed run has the bits of the run without a stop.
TEST(ForcingInTime, DoesNotDependOnTheLevelsBefore) {
  const auto forcing = [](double x, double t) { return std::sin(0.05 * x - 0.02 * t) + 1 / (1 + 0.1 * t); };
  ForcingInTime all(forcing, positions(), step);
  for (long level = 0; level < 2100; ++level) {
    all.at(level, Ranks::single());
    if (level % 300 != 299) continue;
    ForcingInTime resumed(forcing, positions(), step);
    resumed.at(level, Ranks::single());
    for (std::size_t j = 0; j < positions().size(); ++j)
      for (long after = -1; after < 2; ++after) EXPECT_EQ(all(j, after), resumed(j, after)) << level;
  }
}

TEST(ForcingInTime, NeedsFewTermsForAWave) {
  ForcingInTime wave([](double x, double t) { return 0.02 * std::sin(0.01 * (x - 0.5 * t)); }, positions(), step);
  wave.at(700, Ranks::single());
  EXPECT_EQ(wave.terms(0).count, 2);
  EXPECT_GT(wave.reach(), 30);
}

}  // namespace
