// Loading through springs and implicit steps: exact cases, the spring-slider of the field, birth of dislocations.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "chain_cases.hpp"
#include "exact.hpp"
#include "slipfront/chain/measure.hpp"
#include "slipfront/error.hpp"

namespace {

using namespace slipfront;
using chain::Chain;
using chain::End;
using chain::Motion;
using chain::Problem;
using chain::Pulled;

constexpr double turn = 2 * std::numbers::pi;

Problem smooth_block() {
  Problem p;
  p.grid = {0, 0.5, 8};
  p.implicit = true;
  p.substrate = false;
  return p;
}

Motion at_rest(const Problem& p) { return {std::vector<double>(p.grid.sites, 0.0), {}}; }

friction::Friction rate_and_state(double f0, double a, double b, double D, double w0, double theta) {
  for (const friction::Definition* law : friction::laws())
    if (law->name == "rate-and-state") return {*law, {f0, a, b, D, w0, theta, 0}};
  throw std::logic_error("no such law");
}

double budget(const Chain& chain, double first) {
  const double energy = chain::totals(chain).energy(), work = chain.flows().supplied - chain.flows().dissipated;
  return std::fabs(energy - first - work) / std::max({1e-30, std::fabs(energy), std::fabs(chain.flows().supplied)});
}

/// u_tt = kappa (v t - u) from rest: u = v t - (v / omega) sin(omega t).
TEST(Loading, BlockOnASpringWithoutFrictionIsExact) {
  Problem p = smooth_block();
  p.loading = {.stiffness = 0.04, .velocity = 0.3};
  double last = 0;
  for (const double tolerance : {1e-5, 1e-7}) {
    p.tolerance = tolerance;
    Chain chain(p, at_rest(p));
    chain.proceed(100, 1 << 30);
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

/// Far from its other end a string whose end is pulled moves as u = g(t - x), g' + kappa g = kappa v t.
TEST(Loading, PulledEndSendsTheExactWave) {
  for (const Pulled where : {Pulled::left, Pulled::right}) {
    double last = 0;
    for (const double h : {0.2, 0.1}) {
      Problem p = smooth_block();
      p.grid = {0, h, static_cast<std::size_t>(std::lround(40 / h)) + 1};
      p.loading = {.stiffness = 0.5, .velocity = 0.2, .where = where};
      p.tolerance = 1e-7;
      Chain chain(p, at_rest(p));
      chain.proceed(30, 1 << 30);
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

/// Damped motion ends at the velocity of the springs, stretched by C v / kappa.
TEST(Loading, ViscousBlockFollowsItsSprings) {
  Problem p = smooth_block();
  p.friction = friction::viscous(0.7);
  p.loading = {.stiffness = 0.01, .velocity = 0.02};
  Chain chain(p, at_rest(p));
  chain.proceed(5000, 1 << 30);
  const auto w = chain.window(0, 8);
  for (std::size_t j = 0; j < 8; ++j) {
    EXPECT_NEAR(w.velocity[j], 0.02, 1e-8);
    EXPECT_NEAR(0.02 * 5000 - w.u[j], 0.7 * 0.02 / 0.01, 1e-4);
  }
  EXPECT_LT(budget(chain, 0), 1e-12);
  EXPECT_LT(chain.level(), 400);  // long steps where nothing changes
}

/// Growth rate of a small disturbance of steady sliding.
double growth(double stiffness, double v) {
  const double f0 = 0.05, a = 0.01, b = 0.015, D = 1, w0 = 0.01;
  Problem p = smooth_block();
  p.friction = rate_and_state(f0, a, b, D, w0, D / v);
  p.loading = {.stiffness = stiffness, .velocity = v};
  const double steady = a * std::asinh(v / (2 * w0) * std::exp((f0 + b * std::log(w0 / v)) / a));
  p.forcing = [steady](double, double) { return steady; };
  p.tolerance = 2e-9 * v;
  Motion start = at_rest(p);
  start.velocity.assign(8, 1.01 * v);
  Chain chain(p, start);
  return growth_of_peaks(chain, v, 12 * turn * D / v, 1);
}

/// With inertia, kappa_c = ((b - a) / D)(1 + v^2 / (a D)): where the roots of the disturbance's equation are imaginary
/// (tests/reference/spring_slider.py).
TEST(SpringSlider, CriticalStiffnessIsThatOfTheEigenvalues) {
  for (const double v : {0.001, 0.05}) {
    const double exact = 0.005 * (1 + v * v / 0.01);
    const double low = growth(0.99 * exact, v), high = growth(1.01 * exact, v);
    EXPECT_GT(low, 0);
    EXPECT_LT(high, 0);
    const double critical = exact * (0.99 + 0.02 * low / (low - high));
    EXPECT_NEAR(critical / exact, 1, 1e-3) << v;
  }
}

/// Against the numbers that tests/reference/spring_slider.py prints.
TEST(SpringSlider, LimitCycleIsThatOfAHighOrderIntegration) {
  const struct {
    double stiffness, period, peak;
  } cases[] = {{0.0025, 51684.606, 1.0796389}, {0.0012, 107252.6, 2.0393604}};
  for (const auto& c : cases) {
    Problem p = smooth_block();
    p.friction = rate_and_state(0.05, 0.01, 0.015, 1, 0.01, 0);
    p.loading = {.stiffness = c.stiffness, .velocity = 0.001, .event_velocity = 0.01};
    p.tolerance = 3e-6;
    Chain chain(p, at_rest(p));
    chain.proceed(8.5 * c.period, 1 << 30);
    const auto events = chain.events();
    ASSERT_GE(events.size(), 8u);
    const chain::Event &last = events[7], &before = events[6];
    EXPECT_NEAR((last.onset - before.onset) / c.period, 1, 1e-3);
    EXPECT_NEAR(last.peak_velocity / c.peak, 1, 1e-3);
    EXPECT_NEAR(last.stress_drop / (c.stiffness * last.slip), 1, 5e-3);  // the far end moves a little meanwhile
    EXPECT_LT(budget(chain, 0), 1e-10);
    EXPECT_LT(chain.level(), 20000);  // of which each crosses some 30 time units: explicit steps would be 0.5
  }
}

/// The static force that a free end withstands is 2: -u_x = 2 sech(x_0) of a dislocation outside it.
TEST(Birth, AtAPulledEndWhereTheStressPassesTwo) {
  Problem p;
  p.grid = {0, 0.3, 300};
  p.implicit = true;
  p.boundary = {.left = End::free, .right = End::fixed};
  p.friction = friction::viscous(0.5);
  p.loading = {.stiffness = 0.2, .velocity = 0.002, .where = Pulled::left};
  Chain chain(p, at_rest(p));
  double most = 0;
  while (chain::totals(chain).charge < 0.9) {
    chain.proceed(1e9, 1);
    most = std::fmax(most, chain.forcing(0) * 0.15);  // on half a spacing
    ASSERT_LT(chain.time(), 1e5);
  }
  EXPECT_NEAR(most, 2, 0.01);
  chain.proceed(40000, 1 << 30);
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
  Chain chain(p, at_rest(p));
  while (chain::totals(chain).dislocations == 0) {
    chain.proceed(1e5, 1);
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

TEST(Implicit, FollowsExactSolutions) {
  for (const auto& [solution, tolerance] : {std::pair{exact::kink(0.5), 2e-3}, {exact::kink_antikink(0.5), 8e-3}}) {
    Problem p;
    p.grid = {-20, 0.2, 201};
    p.implicit = true;
    p.tolerance = 1e-7;
    const Motion start = exact::motion_of(solution, p.grid, -8);
    Chain chain(p, start);
    const double first = chain::totals(chain).energy();
    chain.proceed(16, 1 << 30);
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
    Chain chain(p, chain::static_train([k](double) { return k; }, p.grid, ring));
    const auto before = chain.window(0, 400);
    const double first = chain::totals(chain).energy();
    chain.proceed(50, 1 << 30);
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
  Chain one(p, start, {.threads = 1}), two(p, start, {.threads = 2}), third(p, start);
  one.proceed(0.3, 1 << 30);
  two.proceed(0.3, 1 << 30);
  third.proceed(0.3, 5);
  const std::vector<double> saved = third.implicit_state();
  Chain resumed(p, start);
  resumed.continue_implicit(saved);
  resumed.proceed(0.3, 1 << 30);
  EXPECT_GT(one.level(), 8);
  const auto same = [](const std::vector<double>& a, const std::vector<double>& b) {
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t i = 0; i < a.size(); ++i) ASSERT_TRUE(a[i] == b[i] || (std::isnan(a[i]) && std::isnan(b[i]))) << i;
  };
  same(one.implicit_state(), two.implicit_state());
  same(one.implicit_state(), resumed.implicit_state());
}

TEST(Implicit, RefusesWhatItCannotDo) {
  const auto refuses = [](const Problem& p) { EXPECT_THROW(Chain(p, at_rest(p)), InputError); };
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

/// A force beyond all doubles: when and where, and the chain stays at its last good step.
TEST(Implicit, SaysWhereAMotionCannotBeFollowed) {
  Problem p = smooth_block();
  p.forcing = [](double x, double t) { return t > 2 && x > 2 ? HUGE_VAL : 0.1; };
  Chain chain(p, at_rest(p));
  try {
    chain.proceed(10, 1 << 30);
    FAIL();
  } catch (const NumericsError& error) {
    EXPECT_NE(std::string(error.what()).find("t = 2"), std::string::npos) << error.what();
    EXPECT_NE(std::string(error.what()).find("x = 2.5"), std::string::npos) << error.what();
  }
  EXPECT_TRUE(std::isfinite(chain.window(0, 8).u[7]));
}

}  // namespace
