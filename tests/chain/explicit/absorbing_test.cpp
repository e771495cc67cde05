#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "chain/explicit/explicit_chain.hpp"
#include "chain/explicit/levels/absorbing_end.hpp"
#include "chain/measure/totals.hpp"
#include "chain/model/initial_train.hpp"
#include "exact_chains.hpp"
#include "slipfront/chain/run.hpp"
#include "slipfront/train/train.hpp"

namespace {

using namespace slipfront;
using namespace slipfront::chain;
using std::numbers::pi;

struct Result {
  double slip, drift, energy_lost;
};

Result run_step(double left_stress, double right_stress, double left, double right, End ends, double scale,
                double end = 2 * pi) {
  ScaledProblem s;
  s.scale = scale;
  s.left = left;
  s.right = right;
  s.stress = [=](double x) { return x < 0 ? left_stress : right_stress; };
  s.boundary = {.left = ends, .right = ends};
  s.spacing = default_spacing / std::cosh(train::psi_of_stress(left_stress));
  Run run(s, {.times = {0, end}, .x_edges = {left, 0, right}}, {});
  run.go();
  const output::Snapshot &first = run.snapshots().front(), &last = run.snapshots().back();
  const double before = first.energy.elastic + first.energy.kinetic;
  return {last.slip_at_origin, run.balance().energy_drift, 1 - (last.energy.elastic + last.energy.kinetic) / before};
}

/// A uniform train loses nothing through absorbing ends, because the ends assume that the train continues outside.
/// Before a correction it lost 8 to 13 % of its energy.
TEST(ChainAbsorbing, StressedTrainStaysAtRest) {
  for (const double stress : {0.3, 0.855, 3.0}) {
    const Result r = run_step(stress, stress, -2, 2, End::absorbing, 100, 20);
    EXPECT_NEAR(r.slip, 0, 0.05 * 2 * pi / 100) << stress;  // 5 % of a dislocation
    EXPECT_NEAR(r.energy_lost, 0, 3e-3) << stress;
  }
}

/// The waves of a step leave through absorbing ends that are as near as a third of their path. The slip at x = 0 is the
/// same as with distant ends, while fixed ends at the same positions change it. The side ahead is empty, or has a train
/// of low or higher stress.
TEST(ChainAbsorbing, PulseLeaves) {
  for (const double right : {0.0, 0.179, 0.5}) {
    const Result far = run_step(0.855, right, -3, 1.5, End::fixed, 400);
    const Result near = run_step(0.855, right, -0.6, 0.25, End::absorbing, 400);
    const Result held = run_step(0.855, right, -0.6, 0.25, End::fixed, 400);
    const double reflected = std::fabs(near.slip - far.slip) / std::fabs(held.slip - far.slip);
    RecordProperty("reflected_" + std::to_string(right), std::to_string(reflected));
    EXPECT_LT(reflected, 0.1) << right << ": " << near.slip << ", " << far.slip << ", " << held.slip;
    EXPECT_LT(near.drift, 5e-3) << right;  // the budget counts the energy that leaves
  }
}

/// The part of its energy that a small wave leaves in an empty chain after it has met an end. An end with the impedance
/// Z would send back ((1 - Z) / (1 + Z))^2 of it.
double energy_that_remains(bool at_right) {
  Problem p;
  p.grid = {-10, 0.1, 201};
  p.boundary = {End::absorbing, End::absorbing, false, 0};
  p.contact = [](double) { return 0.01; };
  const double sign = at_right ? 1 : -1;
  const auto wave = [&](double x, double t) { return 0.3 * std::exp(-(x - sign * t) * (x - sign * t)); };
  ExplicitChain chain(p, exact::motion_of(wave, p.grid, 0));
  const double before = totals(chain).energy();
  chain.advance_to(16);
  const double after = totals(chain).energy();
  EXPECT_NEAR(chain.flows().outflow / (before - after), 1, 5e-3);
  return after / before;
}

TEST(ChainAbsorbing, EndsHaveTheImpedanceOfTheWave) {
  for (const bool at_right : {false, true}) EXPECT_LT(energy_that_remains(at_right), 1e-4);
}

/// A deviation from a train at rest leaves with the velocity 1. Here it is linear over the last spacing, and 0 at the
/// end.
TEST(ChainAbsorbing, DeviationsFromATrainLeaveWithTheVelocityOfWaves) {
  constexpr double stress = 0.855, h = 0.1, dt = 0.09, deviation = 1e-3;
  const double psi0 = train::psi_of_stress(stress);
  const Motion train = static_train([=](double) { return stress; }, {0, h, 101});
  for (const int outward : {-1, 1}) {
    const AbsorbingEnd end{psi0, AbsorbingEnd::shocks_into(psi0), 1, h, dt, 0, outward, 20};
    const std::size_t last = outward > 0 ? 100 : 0, neighbour = outward > 0 ? 99 : 1;
    std::vector<double> now = train.u, next;
    now[neighbour] += deviation;
    for (double& u : now) u /= 2 * pi;
    next = now;
    const double found = 2 * pi * end.step(&now[last], &next[last]).next;
    EXPECT_NEAR(found, train.u[last] + dt / h * deviation, 1e-6);
  }
}

}  // namespace
