#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "chain/explicit/explicit_chain.hpp"
#include "chain/explicit/levels/levels.hpp"
#include "rough_chains.hpp"

namespace {

using namespace slipfront;
using namespace slipfront::chain;

void expect_same(const Levels& a, const Levels& b, const std::string& what) {
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
      if (sites > 10000 && kind != 0 && kind != 1 && kind != 6) continue;  // the longest are worth true threads
      const Problem p = cases::problem(sites, kind);
      const Motion start = cases::bumpy(p);
      const std::string what = std::to_string(sites) + " sites, kind " + std::to_string(kind);
      const auto run = [&](const Execution& e) {
        chain::ExplicitChain c(p, start, e);
        c.advance(301);
        return c.levels();
      };
      const Levels one = run({});
      for (const double z : one.now) ASSERT_TRUE(std::fabs(z) < 1e3) << what;
      expect_same(one, run({.threads = 2}), what + ", two threads");
      expect_same(one, run({.threads = 3, .tile = 104}), what + ", three threads, small tiles");
      expect_same(one, run({.threads = 1, .tile = 200}), what + ", tiles of 200");
      chain::ExplicitChain c(p, start, {});
      for (const long some : {1, 7, 32, 33, 60}) c.advance(some);
      chain::ExplicitChain again(p, c.levels(), {.threads = 2, .tile = 88});
      again.advance(301 - c.steps());
      expect_same(one, again.levels(), what + ", stopped");
    }
}

/// A forcing that is known not to depend on t is asked for once, to the same bits.
TEST(ChainBits, SteadyForcingIsTheSame) {
  Problem p = cases::problem(1501, 3);
  p.forcing = [](double x, double) { return 0.1 * std::sin(0.1 * x); };
  chain::ExplicitChain asked_each_level(p, cases::bumpy(p));
  p.steady_forcing = true;
  chain::ExplicitChain asked_once(p, cases::bumpy(p));
  asked_each_level.advance(100);
  asked_once.advance(100);
  expect_same(asked_each_level.levels(), asked_once.levels(), "steady forcing");
  EXPECT_EQ(asked_each_level.flow_sums(), asked_once.flow_sums());
}

}  // namespace
