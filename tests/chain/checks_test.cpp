#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <string>

#include "slipfront/error.hpp"
#include "slipfront/lattice/chain/run.hpp"
#include "slipfront/theory/train.hpp"

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

output::Schedule outputs_until(const ScaledProblem& s, double end, int cells = 40) {
  output::Schedule when{.times = {0, end}, .x_edges = {}};
  for (int i = 0; i <= cells; ++i) when.x_edges.push_back(s.left + (s.right - s.left) * i / cells);
  return when;
}

/// A force on a few dislocations changes within a few steps. The chain sums the work of force and friction at every
/// time level. When it did so every 32 levels, the work was -473 while the energy rose by 121.
TEST(ChainChecks, WorkOfAFastForceBalances) {
  for (const friction::Friction& f :
       {friction::Friction{}, friction::viscous(0.1), friction::coulomb(0.02), friction::power(0.05, 1.5)}) {
    ScaledProblem s = uniform(0.3, 50, 1);
    s.friction = f;
    s.spacing = 0.25;
    s.forcing = [](double x, double t) { return t < 30 ? 0.4 * std::cos(1.3 * t) * (1 + 0.2 * std::sin(x / 7)) : 0; };
    chain::Run run(s, outputs_until(s, 60), {});
    run.go();
    const output::Energy &first = run.snapshots().front().energy, &last = run.snapshots().back().energy;
    const double gained = last.elastic + last.kinetic - first.elastic - first.kinetic;
    const bool smooth = f.linear_coefficient().has_value();
    EXPECT_GT(last.supplied, 10) << f.parameter("coefficient");
    EXPECT_NEAR(gained, last.supplied - last.dissipated, (smooth ? 2e-3 : 1e-2) * last.supplied)
        << f.parameter("coefficient");
  }
}

/// Only viscous friction acts on a few dislocations; the chain sums its work at every time level.
TEST(ChainChecks, ViscousFrictionOfAFewDislocationsBalances) {
  ScaledProblem s = uniform(0, 60, 1);
  s.stress = [](double x) { return x < -20 ? 0.6 : 0; };
  s.friction = friction::viscous(0.05);
  chain::Run run(s, outputs_until(s, 80), {});
  run.go();
  EXPECT_LT(run.balance().energy_drift, 1e-3);
}

/// U is the velocity of dislocations. It is below c where there are dislocations, and not a number elsewhere. It was
/// -428 ... 75.
TEST(ChainChecks, DislocationsAreSlowerThanC) {
  ScaledProblem s = uniform(0.855, 3, 200);
  s.stress = [](double x) { return x < 0 ? 0.855 : 0; };
  s.boundary = {.left = End::free, .right = End::fixed};
  chain::Run run(s, outputs_until(s, 6), {});
  run.go();
  const output::Profile& p = run.snapshots().back().profile;
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

/// A run warns, and names a sufficient scale, if its scale is so small that the answer is a fraction of one
/// dislocation. A run with a large scale does not warn.
TEST(ChainChecks, WarnsOfTooFewDislocations) {
  for (const double scale : {1.0, 1000.0}) {
    ScaledProblem s = uniform(0.855, 3, scale);
    s.stress = [](double x) { return x < 0 ? 0.855 : 0; };
    chain::Run run(s, outputs_until(s, 6), {});
    run.go();
    std::string all;
    for (const std::string& warning : run.warnings()) all += warning + "\n";
    EXPECT_EQ(all.find("try scale") != std::string::npos, scale < 100) << all;
  }
}

/// A smooth step of small stress moves slowly. If the grid pins slow dislocations, the run warns and names a sufficient
/// spacing.
TEST(ChainChecks, WarnsIfTheGridPinsDislocations) {
  for (const double spacing : {default_spacing, 0.5, 0.6}) {
    ScaledProblem s = uniform(0, 2, 1000);
    s.stress = [](double x) { return 0.533 + 0.148 * (1 - std::tanh(x / 0.5)) / 2; };
    s.friction = friction::viscous(0.257);
    s.spacing = spacing;
    chain::Run run(s, outputs_until(s, 0.05), {});
    run.go();
    std::string all;
    for (const std::string& warning : run.warnings()) all += warning + "\n";
    EXPECT_EQ(all.find("holds slow dislocations") != std::string::npos, spacing > default_spacing) << all;
  }
}

/// A force without friction accelerates a ring until its dislocations are too narrow for the grid. The error names
/// them.
TEST(ChainChecks, NamesNarrowDislocationsInTheError) {
  ScaledProblem s = uniform(0.8, 1, 50);
  s.boundary = {.periodic = true};
  s.forcing = [](double, double) { return 0.5; };
  s.spacing = 0.5;
  chain::Run run(s, outputs_until(s, 6.28), {});
  try {
    run.go();
    ADD_FAILURE() << run.balance().energy_drift;
  } catch (const NumericsError& error) {
    EXPECT_NE(std::string(error.what()).find("narrowest dislocation"), std::string::npos) << error.what();
  }
}

/// Fronts are slower than c and cause no warning, for any step of stress.
TEST(ChainChecks, FrontsAreSlowerThanC) {
  for (const double stress : {0.7, 0.855, 2.0, 4.0}) {
    ScaledProblem s = uniform(stress, 4, 200);
    s.stress = [stress](double x) { return x < 0 ? stress : 0; };
    s.spacing = default_spacing / std::cosh(train::psi_of_stress(stress));
    output::Schedule when = outputs_until(s, 3, 200);
    when.times = {0, 0.5, 1, 2, 3};
    chain::Run run(s, when, {});
    run.go();
    for (const std::string& warning : run.warnings()) EXPECT_EQ(warning.find("front"), std::string::npos) << warning;
    EXPECT_LT(run.snapshots().back().fronts.leading, 3) << stress;
  }
}

/// At free ends, dislocations run into their mirror images. The grid is too coarse for that, so the energy drifts, and
/// the run ends with an error.
TEST(ChainChecks, FailsIfTheEnergyDrifts) {
  ScaledProblem s = uniform(1.5, 3, 200);
  s.spacing = 0.6;
  s.boundary = {.left = End::free, .right = End::free};
  chain::Run run(s, outputs_until(s, 12), {});
  try {
    run.go();
    ADD_FAILURE() << run.balance().energy_drift;
  } catch (const NumericsError& error) {
    EXPECT_NE(std::string(error.what()).find("energy"), std::string::npos) << error.what();
    EXPECT_TRUE(run.can_checkpoint());
    EXPECT_EQ(run.snapshots().size(), 2u);
    EXPECT_THROW(run.go(), NumericsError);  // a run resumed with --resume fails again
  }
}

/// Changes the saved state of a run so that u rises by two turns and falls again, three times. This makes six pairs of
/// an antidislocation and a dislocation, except those that cancel with existing dislocations. The levels are at the end
/// of the state: their number, then u at both levels, each after the number of sites (Run::saved).
std::string with_pairs(std::string saved, std::size_t sites) {
  const std::size_t level = (sites + 1) * sizeof(double);
  for (const std::size_t back : {level, 2 * level}) {
    char* const begin = saved.data() + saved.size() - back + sizeof(double);
    for (std::size_t j = 0; j < sites; ++j) {
      double u = 0;
      std::memcpy(&u, begin + j * sizeof u, sizeof u);
      const auto at = static_cast<double>(j);
      for (const double middle : {100.0, 200.0, 300.0})
        u += std::tanh((at - middle + 20) / 1.5) - std::tanh((at - middle - 20) / 1.5);
      std::memcpy(begin + j * sizeof u, &u, sizeof u);
    }
  }
  return saved;
}

/// Fixed ends conserve the charge, so the charge does not reveal false pairs. The check counts dislocations.
TEST(ChainChecks, DetectsFalsePairsOfDislocations) {
  const ScaledProblem s = uniform(0.855, 80, 1);
  chain::Run cut(s, outputs_until(s, 5), {});
  EXPECT_FALSE(cut.go([] { return true; }));
  for (const std::string& sentence : cut.warnings()) EXPECT_EQ(sentence.find("the ends require"), std::string::npos);
  const std::size_t sites = cut.chain().problem().grid.sites;
  chain::Run broken(s, outputs_until(s, 5), {}, with_pairs(cut.saved(), sites), cut.snapshots());
  EXPECT_NEAR(broken.balance().charge_error, 0, 1e-12);
  EXPECT_GE(broken.balance().dislocations - cut.balance().dislocations, 6);
  std::string all;
  for (const std::string& sentence : broken.warnings()) all += sentence + "\n";
  EXPECT_NE(all.find("dislocations, but the ends require"), std::string::npos) << all;
  EXPECT_THROW(broken.go(), NumericsError);
}

}  // namespace
