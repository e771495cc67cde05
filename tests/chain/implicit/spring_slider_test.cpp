// A spring-slider, the standard model of stick-slip, compared with eigenvalues and with an independent integration
// (tests/reference/spring_slider.py).

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "chain_cases.hpp"
#include "loaded_chains.hpp"

namespace {

using namespace slipfront;
using namespace loaded;
using chain::ImplicitChain;

/// The growth rate of a small disturbance of steady sliding.
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
  ImplicitChain chain(p, start);
  return growth_of_peaks(chain, v, 12 * turn * D / v, 1);
}

/// With inertia, the critical stiffness is kappa_c = ((b - a) / D)(1 + v^2 / (a D)). There the characteristic equation
/// of a small disturbance has imaginary roots (tests/reference/spring_slider.py).
TEST(SpringSlider, CriticalStiffnessAgreesWithTheEigenvalues) {
  for (const double v : {0.001, 0.05}) {
    const double exact = 0.005 * (1 + v * v / 0.01);
    const double low = growth(0.99 * exact, v), high = growth(1.01 * exact, v);
    EXPECT_GT(low, 0);
    EXPECT_LT(high, 0);
    const double critical = exact * (0.99 + 0.02 * low / (low - high));
    EXPECT_NEAR(critical / exact, 1, 1e-3) << v;
  }
}

/// The reference numbers are those that tests/reference/spring_slider.py prints.
TEST(SpringSlider, LimitCycleAgreesWithAHighOrderIntegration) {
  const struct {
    double stiffness, period, peak;
  } cases[] = {{0.0025, 51684.606, 1.0796389}, {0.0012, 107252.6, 2.0393604}};
  for (const auto& c : cases) {
    Problem p = smooth_block();
    p.friction = rate_and_state(0.05, 0.01, 0.015, 1, 0.01, 0);
    p.loading = {.stiffness = c.stiffness, .velocity = 0.001, .event_velocity = 0.01};
    p.tolerance = 2.5e-5;
    ImplicitChain chain(p, at_rest(p));
    chain.advance_to(8.5 * c.period);
    const auto events = chain.events();
    ASSERT_GE(events.size(), 8u);
    const output::SlipEvent &last = events[7], &before = events[6];
    EXPECT_NEAR((last.onset - before.onset) / c.period, 1, 1e-3);
    EXPECT_NEAR(last.peak_velocity / c.peak, 1, 1e-3);
    EXPECT_NEAR(last.stress_drop / (c.stiffness * last.slip), 1,
                5e-3);  // the far end of the spring moves a little during the event
    EXPECT_LT(budget(chain, 0), 1e-10);
    EXPECT_LT(chain.steps(), 20000);  // a step covers about 30 time units; an explicit one would cover 0.5
  }
}

/// The ratio of strength to direct effect is that of laboratory friction. The reference numbers are those that
/// tests/reference/spring_slider.py prints. At rest such a block creeps at 1e-26 and less, so a solver with an absolute
/// tolerance of velocity never lets it slip.
TEST(SpringSlider, LaboratoryFrictionFromRestAgreesWithAHighOrderIntegration) {
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
    ImplicitChain chain(p, at_rest(p));
    chain.advance_to(c.end);
    ASSERT_EQ(chain.events().size(), c.events);
    if (c.events > 0) {
      EXPECT_NEAR(chain.events()[0].onset / c.onset, 1, 1e-3);
      EXPECT_NEAR(chain.events()[0].peak_velocity / c.peak, 1, 2e-3);
    }
    EXPECT_NEAR(chain.window(3, 4).u[0] / c.slip, 1, 1e-3);
    EXPECT_LT(budget(chain, 0), 1e-10);
  }
}

/// A disturbance of steady sliding by 1 % dies out or grows into stick-slip, with the numbers that
/// tests/reference/spring_slider.py prints. The chain starts with slack springs. A constant force that balances
/// friction replaces their tension.
TEST(SpringSlider, LaboratoryFrictionFromSlidingAgreesWithAHighOrderIntegration) {
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
    ImplicitChain chain(p, start);
    chain.advance_to(c.end);
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
      ImplicitChain chain(p, at_rest(p));
      chain.advance_to(ratio * a / (0.004 * v) + 3e5);
      EXPECT_NEAR(chain.window(3, 4).velocity[0] / v, 1, 1e-6) << ratio << slip_law;
    }
}

}  // namespace
