#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "slipfront/chain/run.hpp"
#include "slipfront/error.hpp"
#include "slipfront/rupture/inverse.hpp"

namespace {

using namespace slipfront;
using namespace slipfront::chain;

ScaledProblem uniform(double stress, double half, double scale) {
  ScaledProblem s;
  s.scale = scale;
  s.left = -half;
  s.right = half;
  s.stress = [stress](double) { return stress; };
  s.boundary = {.left = End::fixed, .right = End::fixed};
  return s;
}

pulse::Schedule until(const ScaledProblem& s, double end, int cells = 40) {
  pulse::Schedule when{.times = {0, end}, .x_edges = {}};
  for (int i = 0; i <= cells; ++i) when.x_edges.push_back(s.left + (s.right - s.left) * i / cells);
  return when;
}

/// A few dislocations under a force that changes within a few steps: work of the force and of friction is taken at
/// every level. Sampled every 32 levels it was -473 where the energy rose by 121.
TEST(ChainChecks, WorkOfAFastForceBalances) {
  for (const friction::Friction& f :
       {friction::Friction{}, friction::viscous(0.1), friction::coulomb(0.02), friction::power(0.05, 1.5)}) {
    ScaledProblem s = uniform(0.3, 50, 1);
    s.friction = f;
    s.spacing = 0.25;
    s.forcing = [](double x, double t) { return t < 30 ? 0.4 * std::cos(1.3 * t) * (1 + 0.2 * std::sin(x / 7)) : 0; };
    chain::Run run(s, until(s, 60), {});
    run.go();
    const pulse::Energy &first = run.snapshots().front().energy, &last = run.snapshots().back().energy;
    const double gained = last.elastic + last.kinetic - first.elastic - first.kinetic;
    const bool smooth = f.linear_coefficient().has_value();
    EXPECT_GT(last.supplied, 10) << f.coefficient();
    EXPECT_NEAR(gained, last.supplied - last.dissipated, (smooth ? 2e-3 : 1e-2) * last.supplied) << f.coefficient();
  }
}

/// Viscous friction alone, one dislocation in a chain: its work is taken at every level.
TEST(ChainChecks, ViscousFrictionOfAFewDislocationsBalances) {
  ScaledProblem s = uniform(0, 60, 1);
  s.stress = [](double x) { return x < -20 ? 0.6 : 0; };
  s.friction = friction::viscous(0.05);
  chain::Run run(s, until(s, 80), {});
  run.go();
  EXPECT_LT(run.balance().energy_drift, 1e-3);
}

/// U is the velocity of dislocations: below c where there are any, else no number. It was -428 ... 75.
TEST(ChainChecks, DislocationsAreSlowerThanC) {
  ScaledProblem s = uniform(0.855, 3, 200);
  s.stress = [](double x) { return x < 0 ? 0.855 : 0; };
  s.boundary = {.left = End::free, .right = End::fixed};
  chain::Run run(s, until(s, 6), {});
  run.go();
  const pulse::Profile& p = run.snapshots().back().profile;
  int moving = 0;
  for (std::size_t i = 0; i < p.U.size(); ++i) {
    EXPECT_FALSE(std::fabs(p.U[i]) >= 1) << i;
    if (p.U[i] != 0 && !std::isnan(p.U[i])) {
      EXPECT_NEAR(p.U[i], p.W[i] / p.k[i], 1e-12) << i;
    }
    moving += std::fabs(p.W[i]) > 1e-3;
  }
  EXPECT_GT(moving, 10);
}

/// A scale at which the answer is a share of one dislocation says so, and what would do; a large one does not.
TEST(ChainChecks, SaysWhereDislocationsAreTooFew) {
  for (const double scale : {1.0, 3000.0}) {
    ScaledProblem s = uniform(0.855, 3, scale);
    s.stress = [](double x) { return x < 0 ? 0.855 : 0; };
    chain::Run run(s, until(s, 6), {});
    run.go();
    std::string all;
    for (const std::string& warning : run.warnings()) all += warning + "\n";
    EXPECT_EQ(all.find("chain.scale") != std::string::npos, scale < 100) << all;
  }
}

/// A smooth step of little stress moves slowly. A grid that holds slow dislocations says so, and what would do.
TEST(ChainChecks, SaysWhereTheGridHoldsDislocations) {
  for (const double spacing : {default_spacing, 0.5, 0.6}) {
    ScaledProblem s = uniform(0, 2, 1000);
    s.stress = [](double x) { return 0.533 + 0.148 * (1 - std::tanh(x / 0.5)) / 2; };
    s.friction = friction::viscous(0.257);
    s.spacing = spacing;
    chain::Run run(s, until(s, 0.05), {});
    run.go();
    std::string all;
    for (const std::string& warning : run.warnings()) all += warning + "\n";
    EXPECT_EQ(all.find("holds slow dislocations") != std::string::npos, spacing > default_spacing) << all;
  }
}

/// A force without friction accelerates a ring until its dislocations are too narrow: the message says that.
TEST(ChainChecks, NarrowDislocationsAreNamed) {
  ScaledProblem s = uniform(0.8, 1, 50);
  s.boundary = {.periodic = true};
  s.forcing = [](double, double) { return 0.5; };
  s.spacing = 0.5;
  chain::Run run(s, until(s, 6.28), {});
  try {
    run.go();
    ADD_FAILURE() << run.balance().energy_drift;
  } catch (const NumericsError& error) {
    EXPECT_NE(std::string(error.what()).find("narrowest dislocation"), std::string::npos) << error.what();
  }
}

/// No front is faster than c or warned of, whatever the step.
TEST(ChainChecks, FrontsAreSlowerThanC) {
  for (const double stress : {0.7, 0.855, 2.0, 4.0}) {
    ScaledProblem s = uniform(stress, 4, 200);
    s.stress = [stress](double x) { return x < 0 ? stress : 0; };
    s.spacing = default_spacing / std::cosh(rupture::psi_of_stress(stress));
    pulse::Schedule when = until(s, 3, 200);
    when.times = {0, 0.5, 1, 2, 3};
    chain::Run run(s, when, {});
    run.go();
    for (const std::string& warning : run.warnings()) EXPECT_EQ(warning.find("front"), std::string::npos) << warning;
    EXPECT_LT(run.snapshots().back().fronts.leading, 3) << stress;
  }
}

/// A grid too coarse for what runs into its mirror image: the energy drifts, and that is no result.
TEST(ChainChecks, EnergyThatDriftsIsAnError) {
  ScaledProblem s = uniform(1.5, 3, 200);
  s.spacing = 0.6;
  s.boundary = {.left = End::free, .right = End::free};
  chain::Run run(s, until(s, 12), {});
  try {
    run.go();
    ADD_FAILURE() << run.balance().energy_drift;
  } catch (const NumericsError& error) {
    EXPECT_NE(std::string(error.what()).find("energy"), std::string::npos) << error.what();
    EXPECT_TRUE(run.can_checkpoint());  // to be kept
    EXPECT_EQ(run.snapshots().size(), 2u);
    EXPECT_THROW(run.go(), NumericsError);  // as it is after --resume
  }
}

}  // namespace
