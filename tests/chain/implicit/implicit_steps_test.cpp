// Implicit steps: what they do not depend on, budgets, and where they end a run.

#include <gtest/gtest.h>

#include <cmath>
#include <tuple>
#include <vector>

#include "lattice/chain/explicit/explicit_chain.hpp"
#include "lattice/chain/model/initial_train.hpp"
#include "loaded_chains.hpp"
#include "slipfront/error.hpp"
#include "system/archive.hpp"

namespace {

using namespace slipfront;
using namespace loaded;
using chain::ExplicitChain;
using chain::ImplicitChain;
using chain::Pulled;

/// Springs that pull the other way: the same events, to the bit.
TEST(ImplicitSteps, MirroredLoadingHasTheSameEvents) {
  Problem p = block_of_laboratory();
  ImplicitChain forward(p, at_rest(p));
  p.loading.velocity = -p.loading.velocity;
  ImplicitChain back(p, at_rest(p));
  for (Chain* chain : {&forward, &back}) chain->advance_to(210000);
  ASSERT_EQ(forward.events().size(), 2u);
  ASSERT_EQ(back.events().size(), 2u);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(back.events()[i].onset, forward.events()[i].onset);
    EXPECT_EQ(back.events()[i].slip, forward.events()[i].slip);
    EXPECT_EQ(back.events()[i].stress_drop, forward.events()[i].stress_drop);
    EXPECT_EQ(back.events()[i].peak_velocity, forward.events()[i].peak_velocity);
  }
}

/// Steps are the same whenever the motion is observed, also in the middle of an event.
TEST(ImplicitSteps, DoNotDependOnOutputTimes) {
  const Problem p = block_of_laboratory();
  ImplicitChain once(p, at_rest(p));
  const double end = 210000;
  once.advance_to(end);
  const double onset = once.events().at(0).onset;
  ImplicitChain often(p, at_rest(p));
  for (double t = 1000; t < end; t += 1000) {
    often.advance_to(t);
    EXPECT_EQ(often.time(), t);
  }
  for (int i = 0; i < 100; ++i) often.advance_to(often.time());  // there already: no step
  often.advance_to(end);
  ImplicitChain within(p, at_rest(p));
  for (int i = -50; i < 50; ++i) within.advance_to(onset + 0.3 * i);
  within.advance_to(end);
  for (const Chain* other : {&often, &within}) {
    ASSERT_EQ(other->events().size(), once.events().size());
    for (std::size_t i = 0; i < once.events().size(); ++i)
      for (const auto& column : output::slip_event_columns()) {
        const double a = once.events()[i].*column.value, b = other->events()[i].*column.value;
        EXPECT_TRUE(a == b || (std::isnan(a) && std::isnan(b)));
      }
    EXPECT_EQ(other->steps(), once.steps());
    EXPECT_EQ(other->window(0, 8).u, once.window(0, 8).u);
    EXPECT_EQ(other->window(0, 8).velocity, once.window(0, 8).velocity);
  }
}

/// A run that is saved at an output time, which lies inside a step, continues to the same bits.
TEST(ImplicitSteps, ResumeInsideAStepToTheSameBits) {
  const Problem p = block_of_laboratory();
  ImplicitChain once(p, at_rest(p));
  once.advance_to(169600);
  ImplicitChain resumed(p, at_rest(p));
  restore(resumed, saved(once));
  EXPECT_EQ(resumed.time(), 169600);
  EXPECT_EQ(resumed.window(0, 8).u, once.window(0, 8).u);
  for (Chain* chain : {&once, &resumed}) chain->advance_to(180000);
  EXPECT_EQ(saved(resumed), saved(once));
}

/// A force that changes a million times in a unit of time would take hours.
TEST(ImplicitSteps, EndARunThatMakesNoProgress) {
  Problem p = smooth_block();
  p.forcing = [](double, double t) { return 1e3 * std::sin(1e7 * t); };
  ImplicitChain chain(p, at_rest(p));
  EXPECT_THROW(chain.advance_to(100), NumericsError);
  EXPECT_LT(chain.steps(), 20001);
}

/// Friction of a laboratory on a substrate, f0 / a = 60: a ring that is pulled everywhere, and a chain that is pulled
/// at its end until dislocations are born there.
TEST(ImplicitSteps, BalanceEnergyUnderLaboratoryFrictionOnASubstrate) {
  Problem ring;
  ring.grid = {0, 0.5, 50};
  ring.implicit = true;
  ring.boundary.periodic = true;
  ring.boundary.charge = 8;
  ring.contact = [](double x) { return 1 + 0.05 * std::cos(turn / 25 * x); };
  ring.friction = rate_and_state(6e-3, 1e-4, 1.5e-4, 1, 1e-3, 0);
  ring.loading = {.stiffness = 4e-5, .velocity = 1e-4, .event_velocity = 1e-3};
  Motion train = at_rest(ring);
  for (std::size_t j = 0; j < ring.grid.sites; ++j) train.u[j] = -turn * 8 * static_cast<double>(j) / 50;
  Problem pulled;
  pulled.grid = {-20, 0.5, 81};
  pulled.implicit = true;
  pulled.friction = rate_and_state(0.06, 1e-3, 1.5e-3, 1, 1e-3, 0);
  pulled.loading = {.stiffness = 0.05, .velocity = 1e-4, .where = Pulled::left, .event_velocity = 1e-3};
  for (const auto& [problem, start, end] :
       {std::tuple{ring, train, 1.9e6}, std::tuple{pulled, at_rest(pulled), 5.2e5}}) {
    ImplicitChain chain(problem, start);
    const double first = chain::totals(chain).energy();
    chain.advance_to(end);
    EXPECT_GE(chain.events().size(), 1u);
    EXPECT_LT(std::fabs(chain::totals(chain).energy() - first - chain.flows().supplied + chain.flows().dissipated),
              1e-10 * chain.flows().supplied);
  }
}

/// A force passes the strength of laboratory friction, f0 / a = 60, while the contacts vary around a ring: implicit
/// steps of any length against the explicit scheme, until ten dislocations have passed.
TEST(ImplicitSteps, FollowAnEventAsExplicitStepsDo) {
  Problem p;
  p.grid = {0, 0.5, 50};
  p.boundary.periodic = true;
  p.boundary.charge = 8;
  p.contact = [](double x) { return 1 + 0.05 * std::cos(turn / 25 * x); };
  p.friction = rate_and_state(6e-3, 1e-4, 1.5e-4, 1, 1e-3, 1e4);
  p.forcing = [](double, double t) { return 6.3e-3 + 2e-7 * t - 6e-3 * std::exp(-t / 50); };
  p.tolerance = 1e-4;
  const Motion train = chain::static_train([](double) { return turn * 8 / 25; }, p.grid, true, p.contact);
  const auto slip = [&](const Chain& chain) { return chain.window(20, 21).u[0] - train.u[20]; };
  ExplicitChain by_explicit(p, train);
  by_explicit.advance_to(1200);
  p.implicit = true;
  ImplicitChain by_implicit(p, train);
  by_implicit.advance_to(by_explicit.time());
  EXPECT_GT(slip(by_explicit), 9 * turn);
  EXPECT_NEAR(slip(by_implicit) / slip(by_explicit), 1, 0.01);
}

}  // namespace
