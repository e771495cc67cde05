// Dislocations that loading makes.

#include <gtest/gtest.h>

#include <cmath>

#include "lattice/chain/observe/averages.hpp"
#include "lattice/chain/observe/totals.hpp"
#include "loaded_chains.hpp"

namespace {

using namespace slipfront;
using namespace loaded;
using chain::End;
using chain::ImplicitChain;
using chain::Pulled;

/// The static force that a free end withstands is 2: -u_x = 2 sech(x_0) of a dislocation outside it.
TEST(Birth, AtAPulledEndWhereTheStressPassesTwo) {
  Problem p;
  p.grid = {0, 0.3, 300};
  p.implicit = true;
  p.boundary = {.left = End::free, .right = End::fixed};
  p.friction = friction::viscous(0.5);
  p.loading = {.stiffness = 0.2, .velocity = 0.002, .where = Pulled::left};
  ImplicitChain chain(p, at_rest(p));
  double most = 0;
  while (chain::totals(chain).charge < 0.9) {
    chain.advance_to(1e9, 1);
    most = std::fmax(most, std::fabs(chain.load()));
    ASSERT_LT(chain.time(), 1e5);
  }
  EXPECT_NEAR(most, 2, 0.01);
  chain.advance_to(40000);
  EXPECT_GT(chain::totals(chain).dislocations, 3);
  EXPECT_LT(budget(chain, 0), 1e-10);
}

/// A wide weak spot lets pairs go where F passes its strength a^2; the rest of the chain waits in its wells.
TEST(Birth, InAWeakSpotWhereTheForcePassesItsStrength) {
  Problem p;
  p.grid = {-60, 0.3, 401};
  p.implicit = true;
  p.contact = [](double x) { return std::fabs(x) < 15 ? std::sqrt(0.3) : 1.0; };
  p.friction = friction::viscous(0.5);
  const double rate = 1e-4;
  p.forcing = [rate](double, double t) { return rate * t; };
  ImplicitChain chain(p, at_rest(p));
  while (chain::totals(chain).dislocations == 0) {
    chain.advance_to(1e5, 1);
    ASSERT_LT(chain.time() * rate, 0.5);
  }
  EXPECT_GT(chain.time() * rate, 0.3);
  EXPECT_LT(chain.time() * rate, 0.33);
  const auto pair = chain::dislocations(chain);
  ASSERT_EQ(pair.size(), 2u);
  EXPECT_EQ(pair[0].sign + pair[1].sign, 0);
  EXPECT_NEAR(pair[0].x, -pair[1].x, 1e-6);
  EXPECT_LT(std::fabs(pair[0].x), 25);
}

}  // namespace
