// One implicit step: its error, its order under friction, its balance of energy, and contacts in its middle.

#include "lattice/chain/implicit/implicit_step.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "loaded_chains.hpp"

namespace {

using namespace slipfront;
using namespace loaded;
using chain::ChainState;
using chain::End;
using chain::ImplicitChain;
using chain::ImplicitStep;
using chain::SiteForces;

constexpr std::array<double, 6> lengths = {0.3, 0.5, 0.2, 0.4, 0.7, 0.6};

ChainState moment_at_rest(const Problem& p) {
  ChainState m;
  for (auto* column : {&m.u, &m.v, &m.w, &m.slope, &m.acceleration, &m.earlier}) column->assign(p.grid.sites, 0);
  m.flows.assign(3, 0);
  return m;
}

/// A uniform force f moves a block by u_tt = f. If f is a parabola in time, differences of its values in the middles of
/// steps give u_ttt and u_tttt exactly.
TEST(ImplicitStep, ErrorFollowsFromTheThirdAndTheFourthDerivative) {
  for (const auto& [first, second] : {std::pair{0.5, 0.0}, {0.1, 0.3}, {-0.3, 0.3}}) {
    Problem p = smooth_block();
    p.forcing = [f1 = first, f2 = second](double, double t) { return 2 + f1 * t + f2 * t * t / 2; };
    ChainState m = moment_at_rest(p);
    const SiteForces forces(p, m, Ranks::single());
    ImplicitStep step(forces, 1);
    double last_middle = 0;
    for (std::size_t i = 0; i < lengths.size(); ++i) {
      const double dt = lengths[i], middle = m.time + dt / 2;
      ASSERT_TRUE(step.solve(m, dt));
      const double derivative = std::fmax(std::fabs(first + second * (middle + last_middle) / 2), std::fabs(second));
      if (i >= 2) {
        EXPECT_NEAR(step.error(m, dt) * p.tolerance / (dt * dt * dt / 12 * derivative), 1, 1e-9) << i;
      }
      step.take(m, dt);
      m.time += dt;
      last_middle = middle;
    }
  }
}

/// Friction acts at a velocity that is exact where the acceleration is constant, however strong friction is.
TEST(ImplicitStep, IsExactForALinearVelocityUnderViscousFriction) {
  constexpr double coefficient = 8, acceleration = 0.7;
  Problem p = smooth_block();
  p.friction = friction::viscous(coefficient);
  p.forcing = [](double, double t) { return acceleration + coefficient * acceleration * t; };
  ChainState m = moment_at_rest(p);
  const SiteForces forces(p, m, Ranks::single());
  ImplicitStep step(forces, 1);
  for (const double dt : lengths) {
    ASSERT_TRUE(step.solve(m, dt));
    step.take(m, dt);
    m.time += dt;
    EXPECT_NEAR(m.v[3], acceleration * m.time, 1e-12);
    EXPECT_NEAR(m.u[3], acceleration * m.time * m.time / 2, 1e-12);
  }
}

/// Effective normal stress in the middle of a step is that at the end of half a step.
TEST(SiteForces, ContactsInTheMiddleAreThoseAfterHalfAStep) {
  Problem p = smooth_block();
  for (const friction::Definition* law : friction::laws())
    if (law->name == "rate-and-state") p.friction = {*law, {0.6, 0.01, 0.015, 1, 0.01, 100, 0, 0, 0, 0.05, 3, 0.2}};
  ChainState m = moment_at_rest(p);
  const SiteForces forces(p, m, Ranks::single());
  ASSERT_TRUE(forces.contacts_change());
  const double start = forces.effective_stress(m, 3);
  for (const double dt : {0.5, 4.0}) {
    const double middle = forces.aged(m, 3, 0.4, dt).share;
    EXPECT_GT(std::fabs(middle - start), 1e-3);
    forces.evolve(m, 3, 0.4, dt / 2);
    EXPECT_NEAR(forces.effective_stress(m, 3), middle, 1e-14);
  }
}

struct Ends {
  End left, right;
  bool periodic;
};
constexpr Ends all_ends[] = {{End::free, End::free, false},
                             {End::fixed, End::free, false},
                             {End::free, End::fixed, false},
                             {End::fixed, End::fixed, false},
                             {End::free, End::free, true}};

Problem smooth_chain(chain::Model model, const Ends& ends) {
  Problem p = smooth_block();
  p.model = model;
  p.grid = {0, 0.25, 41};
  p.boundary = {ends.left, ends.right, ends.periodic, ends.periodic ? 1 : 0};
  return p;
}

/// Waves on a smooth surface are linear. One Newton step then solves the equations to rounding, and the rule balances
/// energy and work. Fixed sites do no work.
TEST(ImplicitSteps, BalanceEnergyOfLinearWavesToRounding) {
  for (const chain::Model model : {chain::Model::lattice, chain::Model::sine_gordon})
    for (const Ends& ends : all_ends) {
      Problem p = smooth_chain(model, ends);
      p.tolerance = 1e-2;
      p.forcing = [](double x, double t) { return 0.1 + 0.2 * std::sin(0.8 * x + 2 * t); };
      p.loading = {.stiffness = 0.2, .velocity = 0.1};
      Motion start = at_rest(p);
      for (std::size_t j = 0; j < p.grid.sites; ++j) {
        const double around = turn * static_cast<double>(j) / static_cast<double>(p.grid.sites);
        start.u[j] = 0.3 * std::cos(2 * around) - (ends.periodic ? around : 0);
      }
      ImplicitChain chain(p, start);
      const double first = chain::totals(chain).energy();
      chain.advance_to(20);
      EXPECT_LT(budget(chain, first), 1e-12) << ends.periodic;
      const auto window = chain.window(0, p.grid.sites);
      if (ends.left == End::fixed) {
        EXPECT_EQ(window.velocity.front(), 0);
      }
      if (ends.right == End::fixed) {
        EXPECT_EQ(window.velocity.back(), 0);
      }
    }
}

/// The stencil of the stress multiplies a sine by a known factor, also at the ends, where u continues as its image.
TEST(ImplicitChain, StressesAreThoseOfStandingWaves) {
  const double h = 0.25, height = 0.1;
  for (const chain::Model model : {chain::Model::lattice, chain::Model::sine_gordon})
    for (const Ends& ends : all_ends) {
      const Problem p = smooth_chain(model, ends);
      const double sites = 41, length = ends.periodic ? sites * h : (sites - 1) * h;
      const bool same = ends.left == ends.right;
      const double k = turn / 2 * (ends.periodic ? 6 : same ? 3 : 2.5) / length;
      const double factor = model == chain::Model::lattice
                                ? std::sin(k * h) / h
                                : (45 * std::sin(k * h) - 9 * std::sin(2 * k * h) + std::sin(3 * k * h)) / (30 * h);
      const double slope = ends.periodic ? turn / length : 0, offset = ends.left == End::fixed ? 0 : turn / 4;
      Motion start = at_rest(p);
      for (std::size_t j = 0; j < p.grid.sites; ++j)
        start.u[j] = height * std::sin(k * p.grid.x(j) + offset) - slope * p.grid.x(j);
      const ImplicitChain chain(p, start);
      const auto window = chain.window(0, p.grid.sites);
      for (std::size_t j = 0; j < p.grid.sites; ++j)
        EXPECT_NEAR(window.stress[j], slope - height * factor * std::cos(k * p.grid.x(j) + offset), 1e-12) << j;
    }
}

}  // namespace
