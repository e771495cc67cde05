// Loading through springs: exact cases.

#include <gtest/gtest.h>

#include <cmath>

#include "lattice/chain/observe/totals.hpp"
#include "loaded_chains.hpp"

namespace {

using namespace slipfront;
using namespace loaded;
using chain::ImplicitChain;
using chain::Pulled;

/// u_tt = kappa (v t - u) from rest: u = v t - (v / omega) sin(omega t).
TEST(Loading, BlockOnASpringWithoutFrictionIsExact) {
  Problem p = smooth_block();
  p.loading = {.stiffness = 0.04, .velocity = 0.3};
  double last = 0;
  for (const double tolerance : {1e-5, 1e-7}) {
    p.tolerance = tolerance;
    ImplicitChain chain(p, at_rest(p));
    chain.advance_to(100);
    const double omega = 0.2, t = chain.time(), exact = 0.3 * t - 0.3 / omega * std::sin(omega * t);
    const double error = std::fabs(chain.window(3, 4).u[0] - exact);
    EXPECT_LT(error, 2000 * tolerance);
    if (last > 0) {
      EXPECT_GT(last / error, 15);  // 100^(2/3) = 21.5: second order
    }
    last = error;
    EXPECT_LT(budget(chain, 0), 1e-13);
    const double stretch = 0.3 * t - exact;
    EXPECT_NEAR(chain::totals(chain).loading, 0.04 * stretch * stretch / 2 * 3.5, 1e-2);
  }
}

/// Between fixed ends u = x (L - x) (1 - cos t) / 10, of which springs of fourth order make no error in space: F and
/// the springs drive both ends, which do not move.
TEST(Loading, ForceAtFixedEndsIsExactInSpace) {
  constexpr double length = 4, stiffness = 0.3, velocity = 0.5;
  const auto shape = [](double x) { return x * (length - x) / 10; };
  for (const double h : {0.4, 0.2}) {
    Problem p = smooth_block();
    p.grid = {0, h, static_cast<std::size_t>(std::lround(length / h)) + 1};
    p.boundary = {.left = End::fixed, .right = End::fixed};
    p.loading = {.stiffness = stiffness, .velocity = velocity};
    p.forcing = [shape](double x, double t) {
      const double u = shape(x) * (1 - std::cos(t)), bend = -0.2 * (1 - std::cos(t));
      return shape(x) * std::cos(t) - bend - stiffness * (velocity * t - u);
    };
    p.tolerance = 1e-8;
    ImplicitChain chain(p, at_rest(p));
    chain.advance_to(5);
    const auto w = chain.window(0, p.grid.sites);
    for (std::size_t j = 0; j < w.u.size(); ++j) EXPECT_NEAR(w.u[j], shape(w.x[j]) * (1 - std::cos(5.0)), 1e-5) << h;
    EXPECT_LT(budget(chain, 0), 1e-12);
  }
}

/// As above, with springs that vary in stiffness and velocity, and a part without springs.
TEST(Loading, SpringsThatVaryAreExactInSpace) {
  constexpr double length = 4, end = 5;
  const auto shape = [](double x) { return x * (length - x) / 10; };
  const auto stiffness = [](double x) { return x < 1 ? 0 : 0.3 + 0.1 * std::sin(x); };
  const auto velocity = [](double x) { return 0.5 - 0.4 * x; };  // both forward and backward
  for (const double h : {0.4, 0.2}) {
    Problem p = smooth_block();
    p.grid = {0, h, static_cast<std::size_t>(std::lround(length / h)) + 1};
    p.boundary = {.left = End::fixed, .right = End::fixed};
    p.loading = {.stiffness = 0.4, .velocity = -1.1, .stiffness_at = stiffness, .velocity_at = velocity};
    p.forcing = [&](double x, double t) {
      const double u = shape(x) * (1 - std::cos(t)), bend = -0.2 * (1 - std::cos(t));
      return shape(x) * std::cos(t) - bend - stiffness(x) * (velocity(x) * t - u);
    };
    p.tolerance = 1e-8;
    ImplicitChain chain(p, at_rest(p));
    chain.advance_to(end);
    const auto w = chain.window(0, p.grid.sites);
    double load = 0, stored = 0;
    for (std::size_t j = 0; j < w.u.size(); ++j) {
      const double u = shape(w.x[j]) * (1 - std::cos(end)), stretch = velocity(w.x[j]) * end - u;
      const double weight = j == 0 || j + 1 == w.u.size() ? h / 2 : h;
      EXPECT_NEAR(w.u[j], u, 1e-5) << h;
      load += weight * (p.forcing(w.x[j], end) + stiffness(w.x[j]) * stretch) / length;
      stored += weight * stiffness(w.x[j]) * stretch * stretch / 2;
    }
    EXPECT_NEAR(chain.load(), load, 1e-5);
    EXPECT_NEAR(chain::totals(chain).loading, stored, 1e-4);
    EXPECT_LT(budget(chain, 0), 1e-12);
  }
}

/// Far from its other end a string whose end is pulled moves as u = g(t - x), g' + kappa g = kappa v t.
TEST(Loading, PulledEndSendsTheExactWave) {
  for (const Pulled where : {Pulled::left, Pulled::right}) {
    double last = 0;
    for (const double h : {0.2, 0.1}) {
      Problem p = smooth_block();
      p.grid = {0, h, static_cast<std::size_t>(std::lround(40 / h)) + 1};
      p.loading = {.stiffness = 0.5, .velocity = 0.2, .where = where};
      p.tolerance = 1e-7;
      ImplicitChain chain(p, at_rest(p));
      chain.advance_to(30);
      const auto w = chain.window(0, p.grid.sites);
      double most = 0;
      for (std::size_t j = 0; j < w.u.size(); ++j) {
        const double x = where == Pulled::left ? w.x[j] : 40 - w.x[j], t = 30 - x;
        const double g = t > 0 ? 0.2 * (t - 2 * (1 - std::exp(-0.5 * t))) : 0;
        most = std::fmax(most, std::fabs(w.u[j] - g));
      }
      EXPECT_LT(most, 0.1 * h);
      if (last > 0) {
        EXPECT_GT(last / most, 1.7);
      }
      last = most;
      EXPECT_LT(budget(chain, 0), 1e-12);
    }
  }
}

/// A string between a pulled and a free end that slides steadily: C v = u_xx, and the stress on the pulled end is C v
/// times the length. Each length and spacing gives the same numbers to rounding.
TEST(Loading, SteadySlidingOfAPulledStringIsExact) {
  const double C = 5, v = 0.01, kappa = 2, end = 2000;
  for (const double h : {0.4, 0.2, 0.1})
    for (const Pulled where : {Pulled::left, Pulled::right}) {
      Problem p = smooth_block();
      p.grid = {-3, h, static_cast<std::size_t>(std::lround(6 / h)) + 1};
      p.friction = friction::viscous(C);
      p.loading = {.stiffness = kappa, .velocity = v, .where = where};
      p.tolerance = 1e-9;
      ImplicitChain chain(p, at_rest(p));
      chain.advance_to(end);
      const double length = h * static_cast<double>(p.grid.sites - 1), stress = C * v * length, t = chain.time();
      EXPECT_NEAR(chain.load(), stress, 1e-7) << h;
      const auto w = chain.window(0, p.grid.sites);
      for (std::size_t j = 1; j + 1 < w.u.size(); ++j) {
        const double x = where == Pulled::left ? w.x[j] + 3 : 3 - w.x[j];
        const double exact = v * t - stress / kappa - stress * x + C * v * x * x / 2;
        EXPECT_NEAR(w.u[j], exact, 1e-6) << h << " " << j;
      }
    }
}

/// Damped motion ends at the velocity of the springs, stretched by C v / kappa.
TEST(Loading, ViscousBlockFollowsItsSprings) {
  Problem p = smooth_block();
  p.friction = friction::viscous(0.7);
  p.loading = {.stiffness = 0.01, .velocity = 0.02};
  ImplicitChain chain(p, at_rest(p));
  chain.advance_to(5000);
  const auto w = chain.window(0, 8);
  for (std::size_t j = 0; j < 8; ++j) {
    EXPECT_NEAR(w.velocity[j], 0.02, 1e-8);
    EXPECT_NEAR(0.02 * 5000 - w.u[j], 0.7 * 0.02 / 0.01, 1e-4);
  }
  EXPECT_LT(budget(chain, 0), 1e-12);
  EXPECT_LT(chain.steps(), 400);  // long steps where nothing changes
}

/// Friction that is steep at rest and has no state. The force of the springs ends as C v^n.
TEST(Loading, BlockUnderPowerFrictionFollowsItsSprings) {
  Problem p = smooth_block();
  p.friction = friction::power(0.3, 0.3);
  p.loading = {.stiffness = 0.01, .velocity = 0.002};
  ImplicitChain chain(p, at_rest(p));
  chain.advance_to(2e4);
  const auto w = chain.window(3, 4);
  EXPECT_NEAR(w.velocity[0], 0.002, 1e-6);
  EXPECT_NEAR(0.01 * (0.002 * 2e4 - w.u[0]), 0.3 * std::pow(0.002, 0.3), 1e-5);
  EXPECT_LT(budget(chain, 0), 1e-12);
}

}  // namespace
