// What a run finds wrong in its own results, and what it must not.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "slipfront/friction/law.hpp"
#include "slipfront/pulse/run.hpp"
#include "slipfront/scenario/scenario.hpp"
#include "slipfront/setup/problem.hpp"

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

/// x = 0 is a place that does not slip: what its two slips differ by is small compared with the slip elsewhere.
TEST(RunChecks, AcceptsARunWhoseOriginDoesNotSlip) {
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

/// Friction that holds all cells in every step leaves no motion to compare with: only rounding changes the energy.
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
    const Problem p = setup::pulse_problem(s);
    pulse::Run run(p, setup::pulse_schedule(s, p));
    EXPECT_TRUE(run.go());
    EXPECT_TRUE(run.warnings().empty());
  }
}

/// Profiles held at rest by a load: what moves is the truncation error of the cells, whose slip and energy balance no
/// better than the forces do.
TEST(RunChecks, AcceptsAHeldProfile) {
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
    const Problem p = setup::pulse_problem(s);
    pulse::Run run(p, setup::pulse_schedule(s, p));
    EXPECT_TRUE(run.go());
    EXPECT_LT(std::fabs(run.snapshots().back().slip_at_origin), 1e-8);
  }
}

/// Without friction all energy released is kinetic, however slow: 1e-17 of an elastic energy of 0.6. It once was lost
/// in the truncation error of the elastic energy, and "100 % of the energy of motion" with it.
TEST(RunChecks, EnergyOfASlowPulseIsAccountedFor) {
  const Problem p{.stress = [](double x) { return x < 0 ? 0.1598 : 0.04344; },
                  .forcing = {},
                  .friction = {},
                  .left = -3,
                  .right = 1,
                  .cells = 200};
  const output::Energy e = end_of(p, 1.119e7).energy;
  EXPECT_GT(e.kinetic, 0);
  EXPECT_LT(std::fabs(e.shocks), 0.1 * e.kinetic);
}

/// By the closure of the paper friction hardly slows the dislocations at a free edge, and they leave the others far
/// behind. A cell next to one that is a hundred times wider had next to no width at its centre, and the pressure of
/// that threw its neighbours away: to x = 13.3 by the end with these cells, with energy from nothing.
TEST(RunChecks, AFreeEdgeIsNotThrownAway) {
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
  EXPECT_GT(s.energy.shocks, -1e-3 * (s.energy.kinetic + s.energy.dissipated));
}

/// A strong step under friction that is steep at rest but does not rule what moves: no spike at the foot of the fan,
/// by either closure. The peak was 1.036 by the closure of the paper.
TEST(RunChecks, FrictionSteepAtRestMakesNoSpike) {
  const Problem p{.stress = [](double x) { return x < 0 ? 3.732 : 1.505; },
                  .forcing = {},
                  .friction = friction::power(0.1919, 0.5437, friction::Closure::paper),
                  .left = -2.2,
                  .right = 2.2,
                  .cells = 120};
  EXPECT_NEAR(end_of(p, 1.888).peak_slip_velocity, 0.9045, 4e-3);
}

/// Friction whose mean is not tabulated, on a train that ends in a stress so small that its psi is hardly a double.
TEST(RunChecks, StepsWhereATrainIsAlmostEmpty) {
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

/// The front of a smooth stress does not depend on whether the cells show a corner: -1.499 with 200 cells once, where
/// 800 gave -1.588.
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
