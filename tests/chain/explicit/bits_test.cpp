#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "lattice/chain/explicit/explicit_chain.hpp"
#include "lattice/chain/explicit/levels/kernel.hpp"
#include "rough_chains.hpp"

namespace {

using namespace slipfront;
using namespace slipfront::chain;

struct Outcome {
  Levels levels;
  std::vector<double> flows;
};

Outcome outcome(const chain::ExplicitChain& c) { return {c.levels(), c.flow_sums()}; }

void expect_same(const Outcome& one, const Outcome& other, const std::string& what) {
  const Levels &a = one.levels, &b = other.levels;
  EXPECT_EQ(one.flows, other.flows) << what;
  EXPECT_EQ(a.level, b.level);
  EXPECT_EQ(a.state, b.state) << what;
  for (std::size_t j = 0; j < a.now.size(); ++j) {
    ASSERT_EQ(a.now[j], b.now[j]) << what << ", site " << j;
    ASSERT_EQ(a.before[j], b.before[j]) << what << ", site " << j;
  }
}

/// Threads, tiles and the way that steps are bundled change no bits; nor does a stop.
TEST(ChainBits, DoNotDependOnThreadsTilesOrStops) {
  for (const std::size_t sites : {9u, 50u, 130u, 1501u, 12000u})
    for (int kind = 0; kind < cases::kinds; ++kind) {
      if (sites > 10000 && kind != 0 && kind != 1 && kind != 6 && kind != 11 && kind != 17)
        continue;  // the longest are worth true threads
      const Problem p = cases::problem(sites, kind);
      const Motion start = cases::bumpy(p);
      const std::string what = std::to_string(sites) + " sites, kind " + std::to_string(kind);
      const auto run = [&](const Execution& e) {
        chain::ExplicitChain c(p, start, e);
        c.advance(301);
        return outcome(c);
      };
      const Outcome one = run({});
      for (const double z : one.levels.now) ASSERT_TRUE(std::fabs(z) < 1e3) << what;
      expect_same(one, run({.threads = 2}), what + ", two threads");
      expect_same(one, run({.threads = 3, .tile = 104}), what + ", three threads, small tiles");
      expect_same(one, run({.threads = 1, .tile = 200}), what + ", tiles of 200");
      chain::ExplicitChain c(p, start, {});
      for (const long some : {1, 7, 32, 33, 60}) c.advance(some);
      chain::ExplicitChain again(p, c.levels(), {.threads = 2, .tile = 88});
      again.advance(301 - c.steps());
      const Outcome stopped{again.levels(), one.flows};  // those of `again` begin where it does
      expect_same(one, stopped, what + ", stopped");
      c.advance(301 - c.steps());
      expect_same(one, outcome(c), what + ", in parts");
    }
}

/// A forcing that is known not to depend on t is asked for once.
TEST(ChainBits, SteadyForcingIsTheSame) {
  Problem p = cases::problem(1501, 3);
  p.forcing = [](double x, double) { return 0.1 * std::sin(0.1 * x); };
  chain::ExplicitChain asked_each_level(p, cases::bumpy(p));
  p.steady_forcing = true;
  chain::ExplicitChain asked_once(p, cases::bumpy(p));
  asked_each_level.advance(100);
  asked_once.advance(100);
  const Levels each = asked_each_level.levels(), once = asked_once.levels();
  for (std::size_t j = 0; j < each.now.size(); ++j) ASSERT_NEAR(each.now[j], once.now[j], 1e-13) << j;
  // Up to the error of the polynomial of the force.
  EXPECT_NEAR(asked_each_level.flows().supplied / asked_once.flows().supplied, 1, 1e-9);
  EXPECT_NE(asked_once.flows().supplied, 0);
}

}  // namespace
