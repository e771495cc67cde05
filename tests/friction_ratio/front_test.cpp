#include "slipfront/friction_ratio/front.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "friction_ratio/observed.hpp"
#include "slipfront/error.hpp"
#include "slipfront/rupture/relations.hpp"

namespace {

using namespace slipfront;
using namespace slipfront::friction_ratio;
using friction::Closure;

constexpr Closure closures[] = {Closure::consistent, Closure::paper};
constexpr Drop drops[] = {Drop::origin, Drop::mean};

/// The positions follow from an independent solution with 400 cells, which smears the edge at the lowest threshold.
TEST(FrontRatio, AgreesWithAnIndependentSolution) {
  const double V = rupture::from_stress(0.855).rupture_velocity, T = 2 * 3.14159265358979;
  const auto position = [&](double C, double threshold) {
    return V * T * front_ratio(Closure::consistent, 0.855, C * T, threshold).value;
  };
  EXPECT_NEAR(V * T, 2.290, 1e-3);
  EXPECT_NEAR(position(0.5, 1e-2), 2.281, 3e-3);
  EXPECT_NEAR(position(0.5, 1e-1), 2.190, 1e-3);
  EXPECT_NEAR(position(2, 1e-3), 2.272, 4e-3);
  EXPECT_NEAR(position(2, 1e-2), 2.168, 1e-3);
  EXPECT_NEAR(position(2, 1e-1), 1.697, 1e-3);
  EXPECT_NEAR(position(10, 1e-3), 1.401, 1e-3);
  EXPECT_NEAR(position(10, 1e-2), 1.149, 1e-3);
  EXPECT_NEAR(position(10, 1e-1), 0.793, 1e-3);
}

TEST(FrontRatio, IsTheClosedFormWithoutFriction) {
  for (const Closure closure : closures)
    for (const double stress : {0.05, 0.2, 0.855, 3.0})
      for (const double threshold : {1e-4, 1e-3, 0.02, 0.3})
        EXPECT_NEAR(front_ratio(closure, stress, 0, threshold).value, frictionless_front(stress, threshold), 6e-4)
            << stress << " " << threshold;
}

TEST(FrontRatio, HasDerivativesThatAgreeWithDifferences) {
  for (const Closure closure : closures)
    for (const double threshold : {1e-3, 0.1}) {
      const FrontCurve curve(closure, threshold);
      for (const double damping : {1.5, 15.0, 5e3, 1e7, 1e9})
        for (const double stress : {0.07, 0.9, 2.5}) {
          const Ratio r = curve(stress, damping);
          const double hs = 1e-5 * stress, hg = 1e-5 * damping;
          EXPECT_NEAR(r.by_stress, (curve(stress + hs, damping).value - curve(stress - hs, damping).value) / (2 * hs),
                      1e-6 * r.value / stress);
          EXPECT_NEAR(r.by_damping, (curve(stress, damping + hg).value - curve(stress, damping - hg).value) / (2 * hg),
                      1e-6 * r.value / damping);
        }
    }
}

TEST(FrontRatio, StaysBehindTheFastestDislocation) {
  for (const Closure closure : closures)
    for (const double threshold : {1e-4, 1e-3, 1e-2, 0.3}) {
      const FrontCurve curve(closure, threshold);
      for (const double stress : {0.05, 0.12, 0.5, 1.3, 3.0})
        for (double u = 0; u < 20; u += 0.01) EXPECT_LE(curve(stress, std::expm1(u)).value, 1);
    }
}

TEST(StressDropShare, IsTheClosedFormWithoutFriction) {
  for (const Closure closure : closures)
    for (const double stress : {0.05, 0.12, 0.855, 3.0}) {
      const DropShares exact = frictionless_drops(stress);
      EXPECT_NEAR(stress_drop_share(Drop::origin, closure, stress, 0).value / exact.origin, 1, 1e-3);
      EXPECT_NEAR(stress_drop_share(Drop::mean, closure, stress, 0).value / exact.mean, 1, 1e-3);
    }
}

TEST(StressDropShare, HasDerivativesThatAgreeWithDifferences) {
  for (const Drop drop : drops)
    for (const double damping : {1.5, 15.0, 5e3, 1e7, 1e9})
      for (const double stress : {0.07, 0.9, 2.5}) {
        const auto value = [&](double s, double g) { return stress_drop_share(drop, Closure::consistent, s, g).value; };
        const Ratio r = stress_drop_share(drop, Closure::consistent, stress, damping);
        const double hs = 1e-5 * stress, hg = 1e-5 * damping;
        EXPECT_NEAR(r.by_stress, (value(stress + hs, damping) - value(stress - hs, damping)) / (2 * hs), 1e-6);
        EXPECT_NEAR(r.by_damping, (value(stress, damping + hg) - value(stress, damping - hg)) / (2 * hg),
                    1e-6 / damping);
      }
}

TEST(FrontRatio, RejectsArgumentsOutsideTheTable) {
  const auto at = [](double stress, double damping, double threshold) {
    return front_ratio(Closure::consistent, stress, damping, threshold);
  };
  EXPECT_THROW(at(0.049, 1, 1e-3), InputError);
  EXPECT_THROW(at(NAN, 1, 1e-3), InputError);
  EXPECT_THROW(at(1, -1, 1e-3), InputError);
  EXPECT_THROW(at(1, INFINITY, 1e-3), InputError);
  EXPECT_THROW(at(1, 1, 9e-5), InputError);
  EXPECT_THROW(at(1, 1, 0.31), InputError);
  EXPECT_THROW(at(1, 1, NAN), InputError);
  EXPECT_THROW(stress_drop_share(Drop::mean, Closure::paper, 3.1, 1), InputError);
}

}  // namespace
