// Loading through springs and implicit steps: exact cases, the spring-slider of the field, birth of dislocations.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numbers>
#include <tuple>
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

friction::Friction rate_and_state(double f0, double a, double b, double D, double w0, double theta,
                                  bool slip_law = false) {
  for (const friction::Definition* law : friction::laws())
    if (law->name == "rate-and-state") return {*law, {f0, a, b, D, w0, theta, slip_law ? 1.0 : 0.0}};
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

/// Friction that is steep at rest and has no state. The force of the springs ends as C v^n.
TEST(Loading, BlockUnderPowerFrictionFollowsItsSprings) {
  Problem p = smooth_block();
  p.friction = friction::power(0.3, 0.3);
  p.loading = {.stiffness = 0.01, .velocity = 0.002};
  Chain chain(p, at_rest(p));
  chain.proceed(2e4, 1 << 30);
  const auto w = chain.window(3, 4);
  EXPECT_NEAR(w.velocity[0], 0.002, 1e-6);
  EXPECT_NEAR(0.01 * (0.002 * 2e4 - w.u[0]), 0.3 * std::pow(0.002, 0.3), 1e-5);
  EXPECT_LT(budget(chain, 0), 1e-12);
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
    p.tolerance = 2.5e-5;
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

/// Strength over direct effect as in a laboratory, against the numbers that tests/reference/spring_slider.py prints. At
/// rest such a block creeps at 1e-26 and less; a solver that looks at absolute velocities never lets it slip.
TEST(SpringSlider, LaboratoryFrictionSlipsAsInAHighOrderIntegration) {
  const struct {
    friction::Friction friction;
    double stiffness, velocity, end;
    std::size_t events;
    double onset, peak, slip;
  } cases[] = {
      {rate_and_state(0.6, 0.01, 0.015, 1, 0.01, 100), 0.004, 0.001, 450000, 11, 169505.42, 0.99263893, 301.40003},
      {rate_and_state(0.129, 0.00294, 0.002593, 0.06724, 0.001114, 277.3, true), 0.003593, 0.0009073,
       118714.24557756461, 0, 0, 0, 71.826111},
      {rate_and_state(0.2, 0.001, 0.0015, 0.5, 0.001, 500), 0.0007, 0.0001, 8e6, 29, 2993182.6, 0.32369998, 514.70178}};
  for (const auto& c : cases) {
    Problem p = smooth_block();
    p.friction = c.friction;
    p.loading = {.stiffness = c.stiffness, .velocity = c.velocity, .event_velocity = 10 * c.velocity};
    p.tolerance = 1e-5;
    Chain chain(p, at_rest(p));
    chain.proceed(c.end, 1 << 30);
    ASSERT_EQ(chain.events().size(), c.events);
    if (c.events > 0) {
      EXPECT_NEAR(chain.events()[0].onset / c.onset, 1, 1e-3);
      EXPECT_NEAR(chain.events()[0].peak_velocity / c.peak, 1, 2e-3);
    }
    EXPECT_NEAR(chain.window(3, 4).u[0] / c.slip, 1, 1e-3);
    EXPECT_LT(budget(chain, 0), 1e-10);
  }
}

/// Steady sliding with a disturbance of 1 % dies out or grows into stick-slip, by the numbers that
/// tests/reference/spring_slider.py prints. The chain starts with slack springs; a force that balances friction
/// replaces their stretch.
TEST(SpringSlider, LaboratoryFrictionFromSlidingIsThatOfAHighOrderIntegration) {
  const double f0 = 0.6, a = 0.01, D = 1, w0 = 0.01, v = 0.001, w = 0.00101;
  const struct {
    double b;
    bool slip_law;
    double end;
    std::vector<double> onsets, peaks;
    double slip;
  } cases[] = {{0.008, false, 20000, {}, {}, 20.024856},
               {0.015, false, 120000, {92850.08, 105362.06}, {0.013922308, 0.16375762}, 115.78995},
               {0.015, true, 120000, {93206.179, 110732.44}, {0.17791679, 0.34686377}, 125.36865}};
  for (const auto& c : cases) {
    Problem p = smooth_block();
    p.friction = rate_and_state(f0, a, c.b, D, w0, D / v, c.slip_law);
    p.loading = {.stiffness = 0.004, .velocity = v, .event_velocity = 10 * v};
    const double steady = a * std::asinh(w / (2 * w0) * std::exp((f0 + c.b * std::log(w0 / v)) / a));
    p.forcing = [steady](double, double) { return steady; };
    p.tolerance = 1e-6;
    Motion start = at_rest(p);
    start.velocity.assign(8, w);
    Chain chain(p, start);
    chain.proceed(c.end, 1 << 30);
    const auto events = chain.events();
    ASSERT_EQ(events.size(), c.onsets.size());
    for (std::size_t i = 0; i < events.size(); ++i) {
      EXPECT_NEAR(events[i].onset / c.onsets[i], 1, 1e-3);
      EXPECT_NEAR(events[i].peak_velocity / c.peaks[i], 1, 1e-3);
    }
    EXPECT_NEAR(chain.window(3, 4).u[0] / c.slip, 1, 1e-3);
  }
}

TEST(SpringSlider, SteadySlidingHasTheVelocityOfTheSprings) {
  for (const double ratio : {5.0, 35.0, 100.0, 200.0})
    for (const bool slip_law : {false, true}) {
      const double a = 0.002, v = 0.001;
      Problem p = smooth_block();
      p.friction = rate_and_state(ratio * a, a, 0.0016, 0.1, 0.001, 0, slip_law);
      p.loading = {.stiffness = 0.004, .velocity = v};
      p.tolerance = 1e-7;
      Chain chain(p, at_rest(p));
      chain.proceed(ratio * a / (0.004 * v) + 3e5, 1 << 30);
      EXPECT_NEAR(chain.window(3, 4).velocity[0] / v, 1, 1e-6) << ratio << slip_law;
    }
}

Problem block_of_laboratory() {
  Problem p = smooth_block();
  p.friction = rate_and_state(0.6, 0.01, 0.015, 1, 0.01, 100);
  p.loading = {.stiffness = 0.004, .velocity = 0.001, .event_velocity = 0.01};
  return p;
}

/// Springs that pull the other way: the same events, to the bit.
TEST(ImplicitSteps, MirroredLoadingHasTheSameEvents) {
  Problem p = block_of_laboratory();
  Chain forward(p, at_rest(p));
  p.loading.velocity = -p.loading.velocity;
  Chain back(p, at_rest(p));
  for (Chain* chain : {&forward, &back}) chain->proceed(210000, 1 << 30);
  ASSERT_EQ(forward.events().size(), 2u);
  ASSERT_EQ(back.events().size(), 2u);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(back.events()[i].onset, forward.events()[i].onset);
    EXPECT_EQ(back.events()[i].slip, forward.events()[i].slip);
    EXPECT_EQ(back.events()[i].stress_drop, forward.events()[i].stress_drop);
    EXPECT_EQ(back.events()[i].peak_velocity, forward.events()[i].peak_velocity);
  }
}

/// Steps are the same whenever the motion is looked at, also in the middle of an event.
TEST(ImplicitSteps, DoNotDependOnOutputTimes) {
  const Problem p = block_of_laboratory();
  Chain once(p, at_rest(p));
  const double end = 210000;
  once.proceed(end, 1 << 30);
  const double onset = once.events().at(0).onset;
  Chain often(p, at_rest(p));
  for (double t = 1000; t < end; t += 1000) {
    often.proceed(t, 1 << 30);
    EXPECT_EQ(often.time(), t);
  }
  for (int i = 0; i < 100; ++i) often.proceed(often.time(), 1 << 30);  // there already: no step
  often.proceed(end, 1 << 30);
  Chain within(p, at_rest(p));
  for (int i = -50; i < 50; ++i) within.proceed(onset + 0.3 * i, 1 << 30);
  within.proceed(end, 1 << 30);
  for (const Chain* other : {&often, &within}) {
    ASSERT_EQ(other->events().size(), once.events().size());
    for (std::size_t i = 0; i < once.events().size(); ++i)
      for (const auto& column : output::slip_event_columns()) {
        const double a = once.events()[i].*column.value, b = other->events()[i].*column.value;
        EXPECT_TRUE(a == b || (std::isnan(a) && std::isnan(b)));
      }
    EXPECT_EQ(other->level(), once.level());
    EXPECT_EQ(other->window(0, 8).u, once.window(0, 8).u);
    EXPECT_EQ(other->window(0, 8).velocity, once.window(0, 8).velocity);
  }
}

/// A run that is saved at an output time, which lies inside a step, continues to the same bits.
TEST(ImplicitSteps, ResumeInsideAStepToTheSameBits) {
  const Problem p = block_of_laboratory();
  Chain once(p, at_rest(p));
  once.proceed(169600, 1 << 30);
  Chain resumed(p, at_rest(p));
  resumed.continue_implicit(once.implicit_state());
  EXPECT_EQ(resumed.time(), 169600);
  EXPECT_EQ(resumed.window(0, 8).u, once.window(0, 8).u);
  for (Chain* chain : {&once, &resumed}) chain->proceed(180000, 1 << 30);
  const std::vector<double> a = resumed.implicit_state(), b = once.implicit_state();
  ASSERT_EQ(a.size(), b.size());
  EXPECT_EQ(std::memcmp(a.data(), b.data(), a.size() * sizeof(double)), 0);
}

/// A force that changes a million times in a unit of time would take hours.
TEST(ImplicitSteps, EndARunThatMakesNoProgress) {
  Problem p = smooth_block();
  p.forcing = [](double, double t) { return 1e3 * std::sin(1e7 * t); };
  Chain chain(p, at_rest(p));
  EXPECT_THROW(chain.proceed(100, 1 << 30), NumericsError);
  EXPECT_LT(chain.level(), 20001);
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
    Chain chain(problem, start);
    const double first = chain::totals(chain).energy();
    chain.proceed(end, 1 << 30);
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
  Chain by_explicit(p, train);
  by_explicit.advance_to(1200);
  p.implicit = true;
  Chain by_implicit(p, train);
  by_implicit.proceed(by_explicit.time(), 1 << 30);
  EXPECT_GT(slip(by_explicit), 9 * turn);
  EXPECT_NEAR(slip(by_implicit) / slip(by_explicit), 1, 0.01);
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
