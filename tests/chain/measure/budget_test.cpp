#include <gtest/gtest.h>

#include "exact_chains.hpp"
#include "lattice/chain/explicit/explicit_chain.hpp"
#include "lattice/chain/observe/averages.hpp"
#include "lattice/chain/observe/totals.hpp"

namespace {

using namespace slipfront;
using namespace slipfront::chain;
using std::numbers::pi;

Problem ring(double length, std::size_t sites, long charge) {
  return {.grid = {-length / 2, length / static_cast<double>(sites), sites},
          .model = Model::sine_gordon,
          .boundary = {.periodic = true, .charge = charge},
          .friction = {},
          .forcing = {},
          .contact = {}};
}

/// C = 0, closed, 1e6 steps: the energy error stays bounded and does not grow; charge is exact.
TEST(ChainBudget, EnergyHasNoDriftInAMillionSteps) {
  const Problem p = ring(32, 64, 2);
  const Motion start = exact::motion_of(exact::kink_kink(0.3), p.grid, -10);
  chain::ExplicitChain run(p, {start.u, start.velocity});
  const double first = totals(run).energy();
  double early = 0, late = 0, mean_early = 0, mean_late = 0;
  for (int i = 0; i < 2000; ++i) {
    run.advance(i % 2 == 0 ? 499 : 501);  // not in step with anything
    const Totals t = totals(run);
    const double error = t.energy() / first - 1;
    (i < 1000 ? early : late) = std::fmax(i < 1000 ? early : late, std::fabs(error));
    (i < 1000 ? mean_early : mean_late) += error / 1000;
    ASSERT_EQ(t.charge, 2);
  }
  RecordProperty("largest", std::to_string(early));
  EXPECT_LT(early, 3e-3);
  EXPECT_LT(late, 1.2 * early);
  EXPECT_LT(std::fabs(mean_late - mean_early), 2e-4) << mean_early << " " << mean_late;
  EXPECT_EQ(dislocations(run).size(), 2u);
}

TEST(ChainBudget, TotalsOfADislocationAreTheExactOnes) {
  const double U = 0.6, g = 1 / std::sqrt(1 - U * U);
  Problem p = ring(60, 240, 1);
  chain::ExplicitChain run(p, exact::motion_of(exact::kink(U), p.grid, 0));
  run.advance_to(5);
  const Totals t = totals(run);
  EXPECT_NEAR(t.energy(), 8 * g, 1e-3);
  EXPECT_NEAR(t.momentum, 8 * g * U, 1e-3);
  EXPECT_NEAR(t.kinetic, 4 * g * U * U, 1e-3);
  EXPECT_NEAR(t.substrate, 4 / g, 1e-3);
  EXPECT_EQ(t.charge, 1);
  EXPECT_EQ(t.dislocations, 1);
  const auto found = dislocations(run);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_NEAR(found[0].x, U * run.time(), 1e-3);
  EXPECT_EQ(found[0].sign, 1);
  const Average a = average(run, 0, 50, run.time());
  EXPECT_NEAR(a.stress * 50, 2 * pi, 1e-9);
  EXPECT_NEAR(a.velocity * 50, 2 * pi * U, 5e-4);
}

/// Energy changes by what F supplies less what friction takes, each law.
TEST(ChainBudget, WorkOfForcingAndFrictionBalances) {
  for (const friction::Friction& f : {friction::Friction{}, friction::viscous(0.1), friction::coulomb(0.05),
                                      friction::power(0.1, 2), friction::power(0.05, 0.5)})
    for (const bool forced : {false, true}) {
      Problem p = ring(40, 400, 1);
      p.friction = f;
      if (forced)
        p.forcing = [](double x, double t) { return 0.05 * std::cos(2 * pi * x / 40) * (1 + 0.3 * std::sin(t)); };
      chain::ExplicitChain run(p, exact::motion_of(exact::kink(0.6), p.grid, 0));
      const double first = totals(run).energy();
      run.advance(100);
      const double gained = totals(run).energy() - first;
      const Flows work = run.flows();
      const bool smooth = f.linear_coefficient().has_value();
      EXPECT_NEAR(gained, work.supplied - work.dissipated, smooth ? 3e-4 : 5e-3)
          << f.name() << f.parameter("exponent") << forced;
      EXPECT_EQ(work.dissipated > 0.01, f.acts());
      EXPECT_EQ(work.supplied != 0, forced);
    }
}

/// All sites dissipate, on chains of one and of many tiles. The error is that of the sum of energy.
TEST(ChainBudget, BalancesOnALongChain) {
  for (const std::size_t sites : {200u, 12000u}) {
    Problem p = ring(0.3 * static_cast<double>(sites), sites, static_cast<long>(sites / 200));
    p.friction = friction::viscous(0.1);
    Motion start;
    for (std::size_t j = 0; j < sites; ++j) {
      const double s = static_cast<double>(j) / static_cast<double>(sites);
      start.u.push_back(-2 * pi * static_cast<double>(p.boundary.charge) * s + 3 * std::sin(2 * pi * s));
      start.velocity.push_back(0.5 + 0.3 * std::cos(40 * pi * s));
    }
    chain::ExplicitChain run(p, start);
    const double first = totals(run).energy();
    run.advance(400);
    const double lost = first - totals(run).energy();
    EXPECT_GT(lost, 0.1 * first);
    EXPECT_NEAR(run.flows().dissipated / lost, 1, 4e-4) << sites;
  }
}

/// McLaughlin & Scott (1978): one dislocation under F and C moves at 1 / sqrt(1 + (4 C / pi F)^2).
TEST(ChainBudget, ForcedDislocationHasMcLaughlinScottVelocity) {
  for (const double F : {0.02, 0.05, 0.1})
    for (const double C : {0.05, 0.2}) {
      const double U = 1 / std::sqrt(1 + std::pow(4 * C / (pi * F), 2));
      Problem p = ring(40, 160, 1);
      p.friction = friction::viscous(C);
      p.forcing = [F](double, double) { return F; };
      Motion start = exact::motion_of(exact::kink(U), p.grid, 0);
      for (double& u : start.u) u += std::asin(F);  // the wells have moved
      chain::ExplicitChain run(p, start);
      run.advance_to(6 / C);
      const double from = run.time();
      const Flows before = run.flows();
      const double x0 = dislocations(run).at(0).x;
      run.advance(200);
      double moved = dislocations(run).at(0).x - x0;
      moved += 40 * std::nearbyint((U * (run.time() - from) - moved) / 40);
      EXPECT_NEAR(moved / (run.time() - from) / U, 1, 0.01) << F << " " << C;
      const Flows after = run.flows();
      EXPECT_NEAR((after.supplied - before.supplied) / (after.dissipated - before.dissipated), 1, 0.01);
    }
}

}  // namespace
