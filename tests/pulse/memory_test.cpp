#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "averages/pulse/solver.hpp"
#include "law_values.hpp"
#include "slipfront/averages/pulse/run.hpp"
#include "slipfront/error.hpp"
#include "slipfront/lattice/chain/run.hpp"

namespace {

using namespace slipfront;

/// f_0, a, b, D_c, w_0, age, state.
friction::Friction rate_and_state() {
  return friction::law_of("rate-and-state", {0.05, 0.01, 0.015, 0.05, 0.05, 0, 0});
}
friction::Friction slip_law() { return friction::law_of("rate-and-state", {0.05, 0.01, 0.015, 0.05, 0.05, 0, 1}); }
friction::Friction slip_weakening() { return friction::law_of("slip-weakening", {0.08, 0.02, 0.1}); }

pulse::Problem step(const friction::Friction& friction, int cells) {
  pulse::Problem p;
  p.stress = [](double x) { return x < 0 ? 0.855 : 0.0; };
  p.left = -3;
  p.right = 1;
  p.friction = friction;
  p.cells = cells;
  return p;
}

output::Schedule until(double end) {
  output::Schedule schedule;
  schedule.times = {0, end};
  for (int i = 0; i <= 16; ++i) schedule.x_edges.push_back(-3 + i * 0.25);
  return schedule;
}

double slip(const friction::Friction& friction, int cells, double end) {
  pulse::Run run(step(friction, cells), until(end));
  EXPECT_TRUE(run.go());  // the run checks itself: slip computed in two ways, energy
  return run.snapshots().back().slip_at_origin;
}

double chain_slip(const friction::Friction& friction, double scale, double end) {
  chain::ScaledProblem s;
  s.scale = scale;
  s.left = -3;
  s.right = 1;
  s.stress = [](double x) { return x < 0 ? 0.855 : 0.0; };
  s.friction = friction;
  chain::Run run(s, until(end), {.threads = 2});
  EXPECT_TRUE(run.go());
  return run.snapshots().back().slip_at_origin;
}

/// The pulse is the limit of many dislocations, so its difference from the chain falls with the scale.
TEST(PulseState, SlipAgreesWithTheChain) {
  for (const auto& friction : {rate_and_state(), slip_law(), slip_weakening()}) {
    const double average = slip(friction, 200, 2);
    const double few = chain_slip(friction, 100, 2), many = chain_slip(friction, 400, 2);
    EXPECT_NEAR(average / many, 1, 0.06) << friction.name();
    EXPECT_LT(std::fabs(average - many), 0.8 * std::fabs(average - few)) << friction.name();
  }
}

TEST(PulseState, ConvergesWithTheCells) {
  for (const auto& friction : {rate_and_state(), slip_weakening()}) {
    const double coarse = slip(friction, 100, 2), middle = slip(friction, 200, 2), fine = slip(friction, 400, 2);
    EXPECT_LT(std::fabs(fine - middle), 0.5 * std::fabs(middle - coarse)) << friction.name();
    EXPECT_NEAR(middle / fine, 1, 0.005) << friction.name();
  }
}

/// With f_s = f_d the state has no effect, and the law is Coulomb friction. Two solvers must agree on the same problem.
TEST(PulseState, SlipWeakeningWithoutWeakeningIsCoulombFriction) {
  const double implicit = slip(friction::law_of("slip-weakening", {0.05, 0.05, 1}), 200, 2);
  const double by_events = slip(friction::coulomb(0.05), 200, 2);
  EXPECT_NEAR(implicit / by_events, 1, 2e-3);
}

TEST(PulseState, StopsChangeNoBits) {
  pulse::Run alone(step(rate_and_state(), 40), until(0.5)), stopped(step(rate_and_state(), 40), until(0.5));
  ASSERT_TRUE(alone.go());
  int steps = 0;
  ASSERT_FALSE(stopped.go([&] { return ++steps == 5; }));
  pulse::Run resumed(step(rate_and_state(), 40), until(0.5), stopped.saved(), stopped.snapshots());
  ASSERT_TRUE(resumed.go());
  EXPECT_EQ(alone.saved(), resumed.saved());
  EXPECT_NE(alone.saved().find("state: theta"), std::string::npos);
}

/// If a step compresses cells of the sparse train too much, the solver repeats it with a shorter step. Once it accepted
/// the step, and the next one crashed.
TEST(PulseState, DenseTrainsRunIntoSparseOnes) {
  for (const auto& friction :
       {friction::law_of("rate-and-state", {0.0125, 0.003, 0, 1, 0.05, 0, 0}), friction::power(0.0125, 0.7)}) {
    pulse::Problem p = step(friction, 200);
    p.stress = [](double x) { return x < 0 ? 0.517 : 0.00833; };
    p.left = -3.27;
    p.right = 3.26;
    pulse::Solver solver(p);
    EXPECT_TRUE(solver.advance_to(0.483));
    const double slip = solver.slip_at(solver.view(), 0);
    EXPECT_GT(slip, 0);
    EXPECT_LT(slip, 4e-3);  // the slip without friction is 1.3e-3; 200 cells give 0.7e-3
  }
}

/// Nothing moves under a force below the strength. The fluxes of a smooth stress leak a little.
TEST(PulseState, DoesNotMoveUnderAForceBelowTheStrength) {
  const auto slip_with = [](const friction::Friction& friction) {
    pulse::Problem p = step(friction, 40);
    p.stress = [](double x) { return 0.3 - 0.1 * std::tanh(x); };
    p.corner = HUGE_VAL;
    pulse::Run run(p, until(1));
    EXPECT_TRUE(run.go());
    return std::fabs(run.snapshots().back().slip_at_origin);
  };
  EXPECT_LT(slip_with(friction::law_of("slip-weakening", {1, 0.5, 1})), 1e-3 * slip_with({}));
}

}  // namespace
