#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "chain_cases.hpp"
#include "exact_chains.hpp"
#include "slipfront/lattice/chain/run.hpp"

namespace {

using namespace slipfront;
using friction::LocalState;

/// Friction that weakens with the slip at a position: f = C sign(w) (1 - min(slip / L, 1) / 2).
class Weakening : public friction::Law {
 public:
  explicit Weakening(const std::vector<double>& values) : C_(values[0]), L_(values[1]) {}
  double strength(double, LocalState slip) const override { return C_ * (1 - std::fmin(slip[0] / L_, 1) / 2); }
  const friction::StateEvolution& evolution() const override { return evolution_; }

 private:
  class PathLength : public friction::StateEvolution {
    void start(std::span<double> path) const override { path[0] = 0; }
    void advance(const friction::Slip& slip, double time, std::span<double> path) const override {
      path[0] += std::fabs(slip.mean) * time;
    }
  };
  double C_, L_;
  PathLength evolution_;
};

const friction::Definition& weakening_law() {
  static const friction::Definition definition{
      .name = "weakening",
      .adjective = "weakening",
      .equation = "f = C sign(w) (1 - min(slip / L, 1) / 2)",
      .source = "this test",
      .parameters =
          {{.name = "coefficient", .symbol = "C", .unit = "mu A / 2 pi", .dimension = friction::Dimension::force},
           {.name = "length", .symbol = "L", .unit = "b / 2 pi", .dimension = friction::Dimension::slip}},
      .state = {{.name = "slip", .symbol = "s", .unit = "b / 2 pi"}},
      .make = friction::make_law<Weakening>};
  return definition;
}

chain::ScaledProblem step() {
  chain::ScaledProblem s = small_step();
  s.friction = {weakening_law(), {0.04, 0.05}};
  return s;
}

TEST(ChainState, FrictionFollowsTheSlipOfEachSite) {
  chain::Run run(step(), until(2), {});
  const auto before = run.chain().window(0, run.chain().problem().grid.sites);
  ASSERT_TRUE(run.go());
  const auto after = run.chain().window(0, run.chain().problem().grid.sites);
  const std::vector<double> slip = levels_of(run).state;
  ASSERT_EQ(slip.size(), after.u.size());
  EXPECT_GT(*std::max_element(slip.begin(), slip.end()), 6);
  // The slip of a site is at least its displacement, because waves move it to and fro. z = u + eps sin u is close to u.
  for (std::size_t j = 0; j < slip.size(); ++j) EXPECT_GE(slip[j], after.u[j] - before.u[j] - 0.05) << j;
  EXPECT_LT(run.balance().energy_drift, 2e-4);
  chain::ScaledProblem strong = step();
  strong.friction = friction::coulomb(0.04);
  chain::Run without(strong, until(2), {});
  ASSERT_TRUE(without.go());
  EXPECT_GT(run.snapshots().back().slip_at_origin, 1.01 * without.snapshots().back().slip_at_origin);
}

TEST(ChainState, ThreadsAndStopsChangeNoBits) {
  chain::Run alone(step(), until(1), {});
  chain::Run threads(step(), until(1), {.threads = 3});
  ASSERT_TRUE(alone.go() && threads.go());
  EXPECT_EQ(levels_of(alone).now, levels_of(threads).now);
  EXPECT_EQ(levels_of(alone).state, levels_of(threads).state);
  chain::Run stopped(step(), until(1), {});
  stopped.go([] { return true; });
  ASSERT_FALSE(stopped.finished());
  chain::Run resumed(step(), until(1), {}, stopped.saved(), stopped.snapshots());
  ASSERT_TRUE(resumed.go());
  EXPECT_EQ(alone.saved(), resumed.saved());
  EXPECT_NE(alone.saved().find("slip"), std::string::npos);
}

}  // namespace
