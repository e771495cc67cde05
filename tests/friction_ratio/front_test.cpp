#include <gtest/gtest.h>

#include <cmath>

#include "observed.hpp"
#include "slipfront/error.hpp"
#include "slipfront/friction/ratio/table.hpp"
#include "slipfront/lattice/chain/run.hpp"
#include "slipfront/theory/rupture/relations.hpp"

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

/// The chain computes every dislocation. At Gamma = 12.6 its small waves do not reach past the front.
TEST(FrontRatio, AgreesWithTheChain) {
  constexpr double stress = 0.855, C = 2, T = 6.28;
  const double reach = rupture::from_stress(stress).rupture_velocity * T;
  for (const double threshold : {1e-2, 1e-1}) {
    chain::ScaledProblem problem;
    problem.scale = 400, problem.left = -1.35 * reach, problem.right = 1.1 * reach, problem.end = T;
    problem.stress = [](double x) { return x < 0 ? stress : 0.0; };
    problem.friction = friction::viscous(C);
    problem.boundary.left = chain::End::absorbing, problem.boundary.left_stress = stress;
    output::Schedule schedule{.times = {0, T}, .x_edges = {}, .threshold = threshold};
    for (int i = 0; i <= 400; ++i) schedule.x_edges.push_back(problem.left + (problem.right - problem.left) * i / 400);
    chain::Run run(problem, schedule, {});
    run.go();
    const double front = -run.snapshots().back().fronts.trailing_observed / reach;
    EXPECT_NEAR(front_ratio(Closure::consistent, stress, C * T, threshold).value / front, 1, 3e-3) << threshold;
  }
}

/// The front and the drops of the solver, at points that are not nodes.
TEST(FrontRatio, AgreesWithTheSolver) {
  struct Point {
    double stress, damping;
  };
  for (const Closure closure : closures)
    for (const Point p : {Point{0.07, 0.4}, {0.16, 2.7}, {0.855, 9}, {0.4, 60}, {0.16, 8.8e4}, {1.7, 4e6}}) {
      const Pulse pulse =
          solve_pulse({.stress = p.stress, .damping_number = p.damping, .closure = closure, .cells = 400});
      for (const double threshold : {1e-3, 2e-2, 0.2})
        EXPECT_NEAR(
            front_ratio(closure, p.stress, p.damping, threshold).value / observed_front(pulse, p.stress, threshold), 1,
            2 * front_uncertainty(closure, p.damping))
            << p.stress << " " << p.damping << " " << threshold;
      const DropShares shares = observed_drops(pulse, p.stress);
      EXPECT_NEAR(stress_drop_share(Drop::origin, closure, p.stress, p.damping).value / shares.origin, 1,
                  stress_drop_uncertainty(closure, p.damping));
      EXPECT_NEAR(stress_drop_share(Drop::mean, closure, p.stress, p.damping).value / shares.mean, 1,
                  stress_drop_uncertainty(closure, p.damping));
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
