// The arrivals of slip events at the positions of a loaded chain.

#include <gtest/gtest.h>

#include <cmath>

#include "loaded_chains.hpp"
#include "slipfront/error.hpp"
#include "system/archive.hpp"

namespace {

using namespace slipfront;
using namespace loaded;
using chain::ImplicitChain;
using chain::Pulled;

/// A string that a spring pulls at its left end moves as u = g(t - x) until the wave reaches the other end.
Problem pulled_string() {
  Problem p = smooth_block();
  p.grid = {0, 0.1, 401};
  p.loading = {.stiffness = 0.5, .velocity = 0.2, .where = Pulled::left, .event_velocity = 0.1, .fronts = 40};
  p.tolerance = 1e-7;
  return p;
}

/// The velocity g' = v (1 - exp(-kappa (t - x))) passes v / 2 at t = x + ln(2) / kappa. The event begins when the mean
/// velocity of the whole string passes v / 2, so most of the string moves before it.
TEST(FrontLog, RecordsTheArrivalsOfTheExactWave) {
  const Problem p = pulled_string();
  ImplicitChain chain(p, at_rest(p));
  chain.advance_to(36);
  const output::FrontRecords fronts = chain.fronts();
  ASSERT_EQ(fronts.events.size(), 1u);
  ASSERT_EQ(fronts.x.size(), 40u);
  for (std::size_t i = 0; i < fronts.x.size(); ++i) {
    const double exact = fronts.x[i] + std::log(2) / 0.5;
    if (exact > 36.1) {
      EXPECT_TRUE(std::isnan(fronts.events[0].arrival[i]));
    } else if (exact < 35.9) {
      EXPECT_NEAR(fronts.events[0].arrival[i], exact, 0.06);  // the mean is over ten sites, 0.1 apart
    }
  }
  // The stress of the wave at the onset, 21.6, is -u_x = g'(t - x). Nothing holds the string.
  const double onset = chain.events()[0].onset;
  for (const std::size_t i : {5u, 15u, 35u}) {
    const double wave = onset > fronts.x[i] ? 0.2 * (1 - std::exp(-0.5 * (onset - fronts.x[i]))) : 0;
    EXPECT_NEAR(fronts.events[0].stress[i], wave, 2e-3);
    EXPECT_EQ(fronts.events[0].traction[i], 0);
  }
}

/// At rest the traction balances the springs between sites: f = u_xx.
TEST(FrontLog, RecordsTheTractionThatBalancesTheSprings) {
  Problem p = smooth_block();
  p.grid = {0, 0.5, 80};
  p.model = chain::Model::lattice;
  p.friction = rate_and_state(0.6, 0.01, 0.03, 0.02, 0.01, 10);
  p.loading = {.stiffness = 1, .velocity = 0.001, .where = Pulled::left, .event_velocity = 0.01, .fronts = 20};
  p.tolerance = 1e-3;
  ImplicitChain chain(p, at_rest(p));
  while (chain.events().size() < 8 && chain.time() < 1e6) chain.advance_to(1e6, 1);
  ASSERT_EQ(chain.events().size(), 8u);
  const output::FrontRecord event = chain.fronts().events.back();
  int loaded = 0;
  for (std::size_t i = 2; i + 1 < event.traction.size(); ++i) {
    const double springs = (event.stress[i - 1] - event.stress[i + 1]) / 4;
    if (!std::isnan(event.arrival[i])) continue;
    EXPECT_NEAR(event.traction[i], springs, 0.05) << i;
    loaded += event.traction[i] > 0.3;
  }
  EXPECT_GE(loaded, 2);
}

TEST(FrontLog, ContinuesToTheSameBits) {
  const Problem p = pulled_string();
  ImplicitChain whole(p, at_rest(p)), first(p, at_rest(p)), second(p, at_rest(p));
  whole.advance_to(30);
  first.advance_to(22.5);
  restore(second, saved(first));
  second.advance_to(30);
  const output::FrontRecords a = whole.fronts(), b = second.fronts();
  ASSERT_EQ(a.events.size(), 1u);
  ASSERT_EQ(b.events.size(), 1u);
  for (std::size_t i = 0; i < a.x.size(); ++i) {
    if (std::isnan(a.events[0].arrival[i]))
      EXPECT_TRUE(std::isnan(b.events[0].arrival[i]));
    else
      EXPECT_EQ(a.events[0].arrival[i], b.events[0].arrival[i]);
    EXPECT_EQ(a.events[0].stress[i], b.events[0].stress[i]);
    EXPECT_EQ(a.events[0].traction[i], b.events[0].traction[i]);
  }
}

TEST(FrontLog, RefusesAStateOfOtherPositions) {
  Problem p = pulled_string();
  ImplicitChain chain(p, at_rest(p));
  chain.advance_to(25);
  const std::string state = saved(chain);
  p.loading.fronts = 41;
  ImplicitChain other(p, at_rest(p));
  EXPECT_THROW(restore(other, state), InputError);
}

}  // namespace
