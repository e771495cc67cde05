// The checks of a run on its own results: correct runs must pass, and known errors must not recur.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "slipfront/averages/pulse/run.hpp"
#include "slipfront/friction/law.hpp"
#include "slipfront/scenario/problem.hpp"
#include "slipfront/scenario/scenario.hpp"

namespace {

using namespace slipfront;
using namespace slipfront::pulse;

output::Schedule until(double end, const Problem& p) {
  output::Schedule s{.times = {0, end}, .x_edges = {}};
  for (int i = 0; i <= 200; ++i) s.x_edges.push_back(p.left + (p.right - p.left) * i / 200);
  return s;
}

output::Snapshot end_of(const Problem& p, double end) {
  pulse::Run run(p, until(end, p));
  run.go();
  EXPECT_TRUE(run.warnings().empty()) << run.warnings().front();
  return run.snapshots().back();
}

/// The interface does not slip at x = 0. The two ways to compute that slip differ by little compared with the slip
/// elsewhere.
TEST(RunChecks, AcceptsARunWithoutSlipAtTheOrigin) {
  const Problem p{.stress =
                      [](double x) {
                        return 1.272 + 1.494 * 0.5 * (1 - std::tanh((x + 1.748) / 1.419)) -
                               1.272 * 0.5 * (1 - std::tanh((x - 1.748) / 1.419));
                      },
                  .forcing = {},
                  .friction = friction::viscous(1.323),
                  .left = -19.89,
                  .right = 19.89,
                  .corner = HUGE_VAL,
                  .cells = 200};
  const output::Snapshot s = end_of(p, 7.199);
  EXPECT_LT(std::fabs(s.slip_at_origin), 1e-8);
  EXPECT_GT(std::fabs(s.peak_slip_velocity), 0.04);
}

/// Friction holds all cells in every step, so only rounding changes the energy. There is no motion to compare with.
TEST(RunChecks, AcceptsARunInWhichNothingMoves) {
  for (const int cells : {300, 400}) {
    const std::string text = R"toml([initial]
profile = "tanh"
stress_left = 3.1
stress_right = 0.6294
width = 0.6518
[friction]
law = "rate-and-state"
strength = 0.002177
direct_effect = 0.0007737
evolution_effect = 33.98
characteristic_slip = 1.042e-05
reference_velocity = 0.002593
[time]
end = 0.4662
[domain]
left = -6.3584
right = 3.612
[pulse]
cells = )toml" + std::to_string(cells) +
                             "\n";
    const scenario::Scenario s = scenario::read_scenario(text, "still.toml", {}, {});
    const Problem p = scenario::pulse_problem(s);
    pulse::Run run(p, scenario::pulse_schedule(s, p));
    EXPECT_TRUE(run.go());
    EXPECT_TRUE(run.warnings().empty());
  }
}

/// A load holds the profiles at rest. The only motion is the truncation error of the cells. Its slip and energy balance
/// only as well as the forces do.
TEST(RunChecks, AcceptsAProfileThatALoadHolds) {
  const std::string held = "hold = true\nprofile = \"formula\"\n";
  const std::string dry =
      "[initial]\n" + held +
      R"toml(formula = "0.2162+0.3603*0.5*(1-tanh((x+0.06669)/0.1))+0.2162*exp(-((x+0.3335)/0.1334)^2)"
[friction]
law = "coulomb"
coefficient = 0.004944
[interface]
contact = "1-0.08384*tanh((x+0.1733)/0.318)+0.09264*exp(-((x-0.1102)/0.2581)^2)"
[domain]
left = -1.506
right = 1.506
[time]
end = 3.015
[pulse]
cells = 200
)toml";
  const std::string rate_and_state =
      "[initial]\n" + held +
      R"toml(formula = "0.2723+0.4539*0.5*(1-tanh((x+0.09819)/0.1473))+0.2723*exp(-((x+0.491)/0.1964)^2)"
[friction]
law = "rate-and-state"
strength = 0.05879
direct_effect = 0.01067
evolution_effect = 0.01603
characteristic_slip = 0.001277
reference_velocity = 0.1333
state = "slip"
[interface]
contact = "1-0.1401*tanh((x+0.1063)/0.2978)-0.08762*exp(-((x-0.1805)/0.5297)^2)"
[domain]
left = -2.217
right = 2.217
[time]
end = 2.332
[pulse]
cells = 200
)toml";
  for (const std::string& text : {dry, rate_and_state}) {
    const scenario::Scenario s = scenario::read_scenario(text, "held.toml", {}, {});
    const Problem p = scenario::pulse_problem(s);
    pulse::Run run(p, scenario::pulse_schedule(s, p));
    EXPECT_TRUE(run.go());
    EXPECT_LT(std::fabs(run.snapshots().back().slip_at_origin), 1e-8);
  }
}

/// Without friction all released energy is kinetic, even in a slow pulse: here 1e-17 of an elastic energy of 0.6. Once
/// the truncation error of the elastic energy hid it, and the run reported a loss of "100 % of the energy of motion".
TEST(RunChecks, EnergyBudgetOfASlowPulseCloses) {
  const Problem p{.stress = [](double x) { return x < 0 ? 0.1598 : 0.04344; },
                  .forcing = {},
                  .friction = {},
                  .left = -3,
                  .right = 1,
                  .cells = 200};
  const output::Energy e = end_of(p, 1.119e7).energy;
  EXPECT_GT(e.kinetic, 0);
  EXPECT_LT(std::fabs(e.residual), 0.1 * e.kinetic);
}

/// With the paper's closure, friction hardly slows the dislocations at a free edge, and they leave the others far
/// behind. A cell next to one that is a hundred times wider had almost no width at its centre. The pressure from that
/// error displaced its neighbours, with these cells to x = 13.3 by the end, and created energy.
TEST(RunChecks, FreeEdgeIsNotDisplaced) {
  const Problem p{.stress = [](double x) { return x < 0 ? 0.6161 : 0.0; },
                  .forcing = {},
                  .friction = friction::power(1.931, 1.956, friction::Closure::paper),
                  .left = -66,
                  .right = 6,
                  .cells = 600};
  pulse::Run run(p, until(500, p));
  run.go();
  const output::Snapshot& s = run.snapshots().back();
  EXPECT_LT(s.fronts.leading, 5.5);
  EXPECT_GT(s.energy.residual, -1e-3 * (s.energy.kinetic + s.energy.dissipated));
}

/// A strong step with friction that is steep at rest but weak for moving cells. The foot of the fan must have no spike.
/// With the paper's closure, the peak was 1.036.
TEST(RunChecks, FrictionSteepAtRestMakesNoSpike) {
  const Problem p{.stress = [](double x) { return x < 0 ? 3.732 : 1.505; },
                  .forcing = {},
                  .friction = friction::power(0.1919, 0.5437, friction::Closure::paper),
                  .left = -2.2,
                  .right = 2.2,
                  .cells = 120};
  EXPECT_NEAR(end_of(p, 1.888).peak_slip_velocity, 0.9045, 4e-3);
}

/// The mean of this friction is not tabulated. The train ends in a stress so small that its psi is close to the
/// smallest double.
TEST(RunChecks, RunsWithAnAlmostEmptyTrain) {
  const auto& laws = friction::laws();
  const auto is_n_shaped = [](const friction::Definition* law) { return law->name == "n-shaped"; };
  const friction::Definition& n_shaped = **std::find_if(laws.begin(), laws.end(), is_n_shaped);
  const Problem p{.stress =
                      [](double x) {
                        const double stress = 0.474 * (1 - std::tanh(x / 0.678)) / 2;
                        return stress < 0.0045 ? 0.0 : stress;
                      },
                  .forcing = {},
                  .friction = {n_shaped, {0.81, 0.0497}},
                  .left = -6.78,
                  .right = 6.78,
                  .corner = HUGE_VAL,
                  .cells = 100};
  pulse::Run run(p, until(6.41, p));
  EXPECT_TRUE(run.go());
}

/// The front of a smooth stress does not depend on whether the cells show a corner. Once it was -1.499 with 200 cells
/// and -1.588 with 800.
TEST(RunChecks, TrailingFrontOfASmoothStressConverges) {
  const auto front = [](int cells) {
    const Problem p{.stress =
                        [](double x) {
                          return 0.7522 + 1.599 * 0.5 * (1 - std::tanh((x + 0.09676) / 0.08963)) -
                                 0.7522 * 0.5 * (1 - std::tanh((x - 0.09676) / 0.08963));
                        },
                    .forcing = {},
                    .friction = friction::viscous(0.5),
                    .left = -2.666,
                    .right = 2.666,
                    .corner = HUGE_VAL,
                    .cells = cells};
    pulse::Run run(p, until(1.461, p));
    run.go();
    return run.snapshots().back().fronts;
  };
  const output::Fronts coarse = front(200), half = front(400), fine = front(800);
  EXPECT_LT(std::fabs(fine.trailing - half.trailing), 0.5 * std::fabs(half.trailing - coarse.trailing));
  EXPECT_NEAR(coarse.trailing, fine.trailing, 0.1);
  EXPECT_NEAR(coarse.trailing_characteristic, fine.trailing_characteristic, 2e-3);
}

}  // namespace
