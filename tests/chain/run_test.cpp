#include "slipfront/chain/run.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "slipfront/error.hpp"
#include "slipfront/rupture/relations.hpp"

namespace {

using namespace slipfront;
using std::numbers::pi;

chain::ScaledProblem step(double scale, double C = 0) {
  chain::ScaledProblem s;
  s.scale = scale;
  s.left = -3;
  s.right = 1;
  s.stress = [](double x) { return x < 0 ? 0.855 : 0.0; };
  s.friction = friction::viscous(C);
  s.boundary = {.left = chain::End::fixed, .right = chain::End::fixed};
  return s;
}

output::Schedule schedule(std::vector<double> times) {
  output::Schedule when{.times = std::move(times), .x_edges = {}};
  for (int i = 0; i <= 40; ++i) when.x_edges.push_back(-3 + 0.1 * i);
  return when;
}

/// A ring of one dislocation, which the window of an average surrounds.
TEST(ChainRun, AWindowFitsIntoAShortRing) {
  chain::ScaledProblem s = step(1);
  s.left = -6;
  s.right = 6;
  s.stress = [](double) { return pi / 6; };
  s.boundary = {.periodic = true, .charge = 1};
  chain::Run run(s, {.times = {0, 1}, .x_edges = {-6, 6}}, {});
  EXPECT_TRUE(run.go());
  EXPECT_NEAR(run.snapshots().back().profile.k.front(), pi / 6, 0.1);
}

TEST(ChainRun, FrictionlessStepTendsToTheClosedForm) {
  const auto exact = rupture::from_stress(0.855);
  for (const double scale : {100.0, 400.0, 1600.0}) {
    chain::Run run(step(scale), schedule({0, 2 * pi}), {});
    EXPECT_TRUE(run.go());
    const output::Snapshot& s = run.snapshots().back();
    const double error = std::fabs(s.slip_at_origin / (2 * pi * exact.slip_velocity) - 1);
    EXPECT_LT(error * 2 * pi * exact.slip_velocity, 0.001 + 2 * pi / scale);  // one dislocation
    EXPECT_LT(run.balance().energy_drift, 1e-5);
    EXPECT_EQ(run.balance().charge_error, 0);
    // Nothing moves ahead of the trailing edge.
    for (std::size_t i = 0; i < 40; ++i)
      if (run.schedule().x_edges[i + 1] < -2 * pi * exact.rupture_velocity - 0.2) {
        EXPECT_NEAR(s.profile.W[i], 0, 5e-3);
      }
  }
}

TEST(ChainRun, ScaleChangesOnlyTheNumberOfDislocations) {
  chain::Run small(step(200, 0.5), schedule({0, 1}), {}), large(step(400, 0.5), schedule({0, 1}), {});
  small.go();
  large.go();
  EXPECT_NEAR(static_cast<double>(large.balance().dislocations) / static_cast<double>(small.balance().dislocations), 2,
              0.02);
  EXPECT_NEAR(small.snapshots().back().slip_at_origin, large.snapshots().back().slip_at_origin, 2 * pi / 200);
}

/// The train of a scenario is created with its contact ratio, so that it stays at rest. When psi followed from k
/// without the contact ratio, the energy grew 1300 times.
TEST(ChainRun, UniformTrainWithAnotherContactRatioStaysAtRest) {
  chain::ScaledProblem s = step(300);
  s.stress = [](double) { return 0.8; };
  s.contact = [](double) { return 1.3; };
  s.spacing = chain::default_spacing / 1.3;
  s.boundary = {.periodic = true};
  chain::Run run(s, schedule({0, 2}), {});
  run.go();
  for (const double W : run.snapshots().back().profile.W) EXPECT_NEAR(W, 0, 1e-4);
  EXPECT_NEAR(run.snapshots().back().slip_at_origin, 0, 1e-5);
  EXPECT_LT(run.balance().energy_drift, 1e-5);
  EXPECT_NEAR(run.snapshots().back().energy.phonons / run.snapshots().back().energy.elastic, 0, 1e-4);
}

TEST(ChainRun, ResumedRunHasTheSameBits) {
  const output::Schedule when = schedule({0, 0.5, 1});
  chain::Run whole(step(300, 0.5), when, {.threads = 2});
  whole.go();
  chain::Run cut(step(300, 0.5), when, {});
  int left = 3;
  while (!cut.go([&] { return --left == 0; }) && cut.snapshots().size() < 2) left = 3;
  chain::Run resumed(step(300, 0.5), when, {}, cut.saved(), cut.snapshots());
  resumed.go();
  EXPECT_EQ(whole.saved(), resumed.saved());
  EXPECT_EQ(whole.snapshots().back().profile.slip, resumed.snapshots().back().profile.slip);
  EXPECT_EQ(whole.snapshots().back().energy.dissipated, resumed.snapshots().back().energy.dissipated);
}

TEST(ChainRun, RejectsTheStateOfAnotherRun) {
  chain::Run run(step(100), schedule({0, 0.1}), {});
  run.go();
  EXPECT_THROW(chain::Run(step(200), schedule({0, 0.1}), {}, run.saved(), {}), InputError);
  EXPECT_THROW(chain::Run(step(100), schedule({0, 0.1}), {}, "nonsense", {}), InputError);
}

}  // namespace
