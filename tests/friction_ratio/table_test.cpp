#include "slipfront/friction/ratio/table.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "slipfront/error.hpp"
#include "slipfront/theory/rupture/relations.hpp"
#include "solve.hpp"

namespace {

using namespace slipfront;
using namespace slipfront::friction_ratio;
using friction::Closure;

constexpr Closure both_closures[] = {Closure::consistent, Closure::paper};
constexpr auto& measures = all_slip_velocity_kinds;

/// Checks a few points of `friction_ratio_table check`. None of them is a node of the table.
TEST(FrictionRatio, AgreesWithThePulseSolver) {
  struct Point {
    double stress, damping;
  };
  for (const Closure closure : both_closures)
    for (const Point p :
         {Point{0.06, 0.4}, {0.213, 0.05}, {0.855, 2.7}, {2.6, 1.3}, {0.9, 3e4}, {1.7, 4e6}, {0.3, 7e7}}) {
      const SlipVelocities w = solve({.stress = p.stress, .damping_number = p.damping, .closure = closure});
      const double unit = rupture::from_stress(p.stress).slip_velocity;
      const double wanted[] = {w.origin / unit, w.mean / unit, w.peak / unit, w.time_mean / unit};
      for (const SlipVelocityKind m : measures)
        EXPECT_NEAR(evaluate(m, closure, p.stress, p.damping).value / wanted[static_cast<int>(m)], 1,
                    uncertainty(closure, p.damping))
            << p.stress << " " << p.damping << " " << static_cast<int>(closure) << static_cast<int>(m);
    }
}

/// The points are on both sides of the corners, in Gamma, of W(0) and of the peak. For a stress of 0.0623 these are
/// 0.36 and 1.68, for 0.79 they are 1.27 and 2.58.
TEST(FrictionRatio, FollowsTheCorners) {
  struct Point {
    double stress, damping;
  };
  for (const Point p : {Point{0.0623, 0.30},
                        {0.0623, 0.36},
                        {0.0623, 0.4},
                        {0.0623, 1.66},
                        {0.0623, 1.70},
                        Point{0.79, 1.20},
                        {0.79, 1.27},
                        {0.79, 1.30},
                        {0.79, 2.5},
                        {0.79, 2.6}}) {
    const SlipVelocities w = solve({.stress = p.stress, .damping_number = p.damping, .cells = 800});
    const double unit = rupture::from_stress(p.stress).slip_velocity;
    const double wanted[] = {w.origin / unit, w.mean / unit, w.peak / unit, w.time_mean / unit};
    for (const SlipVelocityKind m : measures)
      EXPECT_NEAR(evaluate(m, Closure::consistent, p.stress, p.damping).value / wanted[static_cast<int>(m)], 1, 3e-5)
          << p.stress << " " << p.damping << " " << static_cast<int>(m);
  }
}

/// The table takes slip over duration from the number of dislocations that have passed x = 0. It must equal the mean of
/// the table's own W(0). Only Gamma = C t matters, so this mean is (1 / Gamma) times the integral of the ratio from 0
/// to Gamma. We integrate over u = ln(1 + Gamma).
TEST(FrictionRatio, IntegratesTheSlipVelocityForTheTimeMean) {
  for (const Closure closure : both_closures)
    for (const double stress : {0.05, 0.2117, 0.855, 2.9})
      for (const double damping : {0.01, 0.7, 21.4, 137.0, 3e3, 2e5, 9e7}) {
        constexpr int intervals = 4000;
        const double step = std::log1p(damping) / intervals;
        double sum = 0;
        for (int i = 0; i <= intervals; ++i) {
          const double weight = i == 0 || i == intervals ? 1 : i % 2 == 1 ? 4 : 2, gamma = std::expm1(i * step);
          sum += weight * evaluate(SlipVelocityKind::origin, closure, stress, gamma).value * (1 + gamma);
        }
        const double mean = sum * step / 3 / damping;
        const bool unstable = closure == Closure::paper && damping > 3;
        EXPECT_NEAR(evaluate(SlipVelocityKind::time_mean, closure, stress, damping).value / mean, 1,
                    unstable ? 1e-2 : 5e-5)
            << stress << " " << damping << " " << static_cast<int>(closure);
      }
}

/// In the paper's ETS event, slip over duration is a fifth of the frictionless slip velocity. This takes Gamma = 21.4,
/// or 137 with the paper's closure. The values 5.7 and 36 belong to W at the end of the event.
TEST(FrictionRatio, TimeMeanOfTheEtsEventIsAFifth) {
  EXPECT_NEAR(evaluate(SlipVelocityKind::time_mean, Closure::consistent, 0.2117, 21.4).value, 0.199, 3e-4);
  EXPECT_NEAR(evaluate(SlipVelocityKind::time_mean, Closure::paper, 0.2117, 137).value, 0.199, 1e-3);
  EXPECT_NEAR(evaluate(SlipVelocityKind::origin, Closure::consistent, 0.2117, 5.74).value, 0.199, 3e-4);
}

TEST(FrictionRatio, OneRunGivesManyDampingNumbers) {
  const std::vector<SlipVelocities> w = solve_each(0.855, Closure::consistent, 400, {0.5, 2});
  ASSERT_EQ(w.size(), 2u);
  EXPECT_NEAR(w[0].origin / solve({.stress = 0.855, .damping_number = 0.5}).origin, 1, 1e-5);
  EXPECT_NEAR(w[1].origin / solve({.stress = 0.855, .damping_number = 2}).origin, 1, 1e-5);
  EXPECT_NEAR(w[0].time_mean / solve({.stress = 0.855, .damping_number = 0.5}).time_mean, 1, 2e-5);
}

/// The reference values are W(0) sqrt(Gamma) of the step 0.855, solved independently of the scheme (docs/pulse.md).
TEST(FrictionRatio, TendsToTheDiffusionLimit) {
  const double unit = rupture::from_stress(0.855).slip_velocity;
  const double damping = 1e12;
  const auto W = [&](Closure c) {
    return evaluate(SlipVelocityKind::origin, c, 0.855, damping).value * unit * std::sqrt(damping);
  };
  EXPECT_NEAR(W(Closure::consistent) / 0.0254766, 1, 3e-5);
  EXPECT_NEAR(W(Closure::paper) / 0.0343860, 1, 3e-5);
}

TEST(FrictionRatio, IsOneWithoutFriction) {
  for (const Closure closure : both_closures)
    for (const double stress : {0.05, 0.0731, 0.5, 3.0})
      EXPECT_NEAR(evaluate(SlipVelocityKind::origin, closure, stress, 0).value, 1, 1e-6);
}

TEST(FrictionRatio, HasDerivativesThatAgreeWithDifferences) {
  for (const Closure closure : both_closures)
    for (const SlipVelocityKind m : measures)
      for (const double damping : {0.3, 1.5, 2.2, 20.0, 5e3, 1e7, 1e9})
        for (const double stress : {0.07, 0.9, 2.5}) {
          const auto value = [&](double s, double g) { return evaluate(m, closure, s, g).value; };
          const Ratio r = evaluate(m, closure, stress, damping);
          const double hs = 1e-5 * stress, hg = 1e-5 * damping;
          EXPECT_NEAR(r.by_stress, (value(stress + hs, damping) - value(stress - hs, damping)) / (2 * hs),
                      1e-6 * r.value / stress);
          EXPECT_NEAR(r.by_damping, (value(stress, damping + hg) - value(stress, damping - hg)) / (2 * hg),
                      1e-6 * r.value / damping);
        }
}

TEST(FrictionRatio, HasTheSameValueWithoutDerivatives) {
  for (const Closure closure : both_closures)
    for (const SlipVelocityKind m : measures)
      for (const double damping : {0.0, 0.3, 1.5, 20.0, 1e7, 1e9})
        for (const double stress : {0.07, 0.9, 2.5})
          EXPECT_DOUBLE_EQ(evaluate_value(m, closure, stress, damping), evaluate(m, closure, stress, damping).value);
}

TEST(FrictionRatio, FallsSmoothlyWithFriction) {
  for (const Closure closure : both_closures)
    for (const SlipVelocityKind m : measures)
      for (const double stress : {0.05, 0.12, 0.5, 1.3, 3.0}) {
        double last = evaluate(m, closure, stress, 0).value;
        for (double u = 0.01; u < 20; u += 0.01) {
          const double now = evaluate(m, closure, stress, std::expm1(u)).value;
          EXPECT_LT(now, last) << stress << " " << std::expm1(u);
          EXPECT_GT(now, 0.98 * last);
          last = now;
        }
      }
}

TEST(FrictionRatio, RejectsArgumentsOutsideTheTable) {
  const auto at = [](double stress, double damping) {
    return evaluate(SlipVelocityKind::origin, Closure::consistent, stress, damping);
  };
  EXPECT_THROW(at(0.049, 1), InputError);
  EXPECT_THROW(at(3.01, 1), InputError);
  EXPECT_THROW(at(NAN, 1), InputError);
  EXPECT_THROW(at(1, -1), InputError);
  EXPECT_THROW(at(1, NAN), InputError);
  EXPECT_THROW(at(1, INFINITY), InputError);
}

}  // namespace
