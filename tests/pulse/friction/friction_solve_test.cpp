// The momentum that implicit friction leaves.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "averages/pulse/friction/cell_friction.hpp"
#include "slipfront/theory/modulation/modulation.hpp"

namespace {

using namespace slipfront;
using pulse::SlowedTrain;
using pulse::SlowedTrains;

/// M + time 2 pi <f>(M) - free, over free.
double residual(const friction::Friction& friction, double spacing, double momentum, double free, double time) {
  const State state = modulation::state_of({spacing, momentum}, 0.5);
  return (momentum + 2 * std::numbers::pi * time * friction.mean_strength(state, 1) - free) / free;
}

TEST(FrictionSolve, SatisfiesTheImplicitEquation) {
  for (const friction::Friction& f : {friction::viscous(0.7), friction::power(0.2, 0.6), friction::power(0.3, 2)})
    for (const double free : {1e-6, 0.1, 3.0})
      for (const double time : {0.01, 1.0, 100.0}) {
        const SlowedTrain train{f, 9, 1, {}, 0.5};
        const SlowedTrain::Result left = train.after(free, time);
        if (left.momentum == 0) continue;
        EXPECT_NEAR(residual(f, 9, left.momentum, free, time), 0, 3e-12) << f.name() << " " << free << " " << time;
        EXPECT_NEAR(train.after(-free, time).momentum, -left.momentum, 0);
      }
}

TEST(FrictionSolve, HoldsATrainThatFrictionCanStop) {
  const friction::Friction coulomb = friction::coulomb(0.1);
  const SlowedTrain train{coulomb, 9, 1, {}, 0.5};
  const double most = 2 * std::numbers::pi * 0.1;  // taken in a unit of time
  EXPECT_EQ(train.after(0.9 * most, 1).momentum, 0);
  EXPECT_NEAR(train.after(2 * most, 1).momentum, most, 1e-10);
}

TEST(FrictionSolve, FindsManyTrainsAsItFindsOne) {
  const friction::Friction f = friction::power(0.2, 0.7);
  constexpr std::size_t n = 21;
  SlowedTrains all(f, n);
  std::vector<double> momentum(n), velocity(n), typical(n), force(n), slope(n), s(n);
  for (std::size_t i = 0; i < n; ++i) {
    const double free = std::pow(10.0, -6 + 0.3 * static_cast<double>(i));
    all.add({i, 9, 1, nullptr, free, free, 0.3});
  }
  all.solve(0.5, {momentum.data(), velocity.data(), typical.data(), force.data(), slope.data(), s.data()});
  for (std::size_t i = 0; i < n; ++i) {
    const double free = std::pow(10.0, -6 + 0.3 * static_cast<double>(i));
    const SlowedTrain::Result one = SlowedTrain{f, 9, 1, {}, 0.5}.after(free, 0.5);
    EXPECT_NEAR(momentum[i], one.momentum, 1e-8 * one.momentum) << i;
    EXPECT_NEAR(velocity[i], one.velocity, 1e-8 * one.velocity) << i;
  }
}

}  // namespace
