// Chains by implicit steps, against exact solutions and explicit steps.

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <utility>

#include "exact_chains.hpp"
#include "lattice/chain/model/initial_train.hpp"
#include "lattice/chain/observe/totals.hpp"
#include "loaded_chains.hpp"
#include "slipfront/error.hpp"
#include "system/archive.hpp"

namespace {

using namespace slipfront;
using namespace loaded;
using chain::End;
using chain::ImplicitChain;
using chain::Pulled;

TEST(Implicit, FollowsExactSolutions) {
  for (const auto& [solution, tolerance] : {std::pair{exact::kink(0.5), 2e-3}, {exact::kink_antikink(0.5), 8e-3}}) {
    Problem p;
    p.grid = {-20, 0.2, 201};
    p.implicit = true;
    p.tolerance = 1e-7;
    const Motion start = exact::motion_of(solution, p.grid, -8);
    ImplicitChain chain(p, start);
    const double first = chain::totals(chain).energy();
    chain.advance_to(16);
    EXPECT_LT(exact::error(chain, solution, -8), tolerance);
    EXPECT_LT(budget(chain, first), 1e-12);
  }
}

/// A train at rest of explicit steps is at rest for implicit ones: around a ring, and between fixed ends.
TEST(Implicit, TrainAtRestStays) {
  for (const bool ring : {true, false}) {
    Problem p;
    p.grid = {0, 0.3, 400};
    p.implicit = true;
    p.boundary = {.left = End::fixed, .right = End::fixed, .periodic = ring, .charge = ring ? 15 : 0};
    const double k = turn * 15 / (0.3 * 400);
    ImplicitChain chain(p, chain::static_train([k](double) { return k; }, p.grid, ring));
    const auto before = chain.window(0, 400);
    const double first = chain::totals(chain).energy();
    chain.advance_to(50);
    const auto after = chain.window(0, 400);
    for (std::size_t j = 0; j < 400; ++j) EXPECT_NEAR(after.u[j], before.u[j], 2e-3) << j;
    EXPECT_NEAR(chain::totals(chain).energy() / first, 1, 1e-13);
  }
}

TEST(Implicit, ThreadsAndStopsChangeNoBits) {
  Problem p;
  p.grid = {0, 0.3, 20101};
  p.boundary = {.left = End::free, .right = End::free};
  p.friction = rate_and_state(0.05, 0.01, 0.015, 6, 0.05, 0);
  p.implicit = true;
  p.loading = {.stiffness = 1e-4, .velocity = 0.1, .event_velocity = 1};
  const Motion start = chain::static_train([](double) { return 0.8; }, p.grid);
  ImplicitChain one(p, start, {.threads = 1}), two(p, start, {.threads = 2}), third(p, start);
  one.advance_to(0.3);
  two.advance_to(0.3);
  third.advance_to(0.3, 5);
  ImplicitChain resumed(p, start);
  restore(resumed, saved(third));
  resumed.advance_to(0.3);
  EXPECT_GT(one.steps(), 8);
  EXPECT_EQ(saved(one), saved(two));
  EXPECT_EQ(saved(one), saved(resumed));
}

TEST(Implicit, RejectsConditionsThatItDoesNotSupport) {
  const auto refuses = [](const Problem& p) { EXPECT_THROW(ImplicitChain(p, at_rest(p)), InputError); };
  Problem p = smooth_block();
  p.boundary.left = End::absorbing;
  refuses(p);
  p = smooth_block();
  p.friction = friction::coulomb(0.1);
  refuses(p);
  p = smooth_block();
  p.loading = {.stiffness = 1, .velocity = 1, .where = Pulled::left};
  p.boundary.left = End::fixed;
  refuses(p);
}

/// A force larger than any double. The error states time and position, and the chain stays at its last good step.
TEST(Implicit, StatesWhereTheMotionCannotBeFollowed) {
  Problem p = smooth_block();
  p.forcing = [](double x, double t) { return t > 2 && x > 2 ? HUGE_VAL : 0.1; };
  ImplicitChain chain(p, at_rest(p));
  try {
    chain.advance_to(10);
    FAIL();
  } catch (const NumericsError& error) {
    EXPECT_NE(std::string(error.what()).find("t = 2"), std::string::npos) << error.what();
    EXPECT_NE(std::string(error.what()).find("x = 2.5"), std::string::npos) << error.what();
  }
  EXPECT_TRUE(std::isfinite(chain.window(0, 8).u[7]));
}

}  // namespace
