// Smooth slow stresses under strong friction or a forcing, where friction damps a wave before it has crossed a cell.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "averages/pulse/checks/checks.hpp"
#include "averages/pulse/solver.hpp"
#include "slipfront/averages/pulse/run.hpp"

namespace {

using namespace slipfront;
using namespace slipfront::pulse;
using friction::Friction;
using std::numbers::pi;

double slip_at_origin(const Solver& s) { return s.slip_at(s.view(), 0); }

Problem forced(double stress, double C, double reach, std::function<double(double, double)> forcing) {
  return {.stress = [=](double) { return stress; },
          .forcing = std::move(forcing),
          .friction = friction::viscous(C),
          .left = -reach,
          .right = reach,
          .corner = HUGE_VAL};
}

/// The slip of a uniform train: the integral of k U, where M' = 2 pi F - C M. The train approaches McLaughlin & Scott's
/// speed.
double slip_of_uniform_train(double stress, double C, double end, const std::function<double(double)>& F) {
  const int steps = 200000;
  const double h = end / steps;
  double momentum = 0, slip = 0;
  for (int i = 0; i < steps; ++i) {  // the midpoint rule
    const double middle = momentum + h / 2 * (2 * pi * F(i * h) - C * momentum);
    slip += h * stress * std::tanh(std::asinh(middle / 8));
    momentum += h * (2 * pi * F((i + 0.5) * h) - C * middle);
  }
  return slip;
}

/// Here the friction time is about as long as the run, and the time in which a wave crosses a cell is a thousand times
/// longer. Momenta never balance the pressure, and the scheme must not assume at the faces that they do.
TEST(UnderLoad, SlipConvergesBeforeTheMomentumRelaxes) {
  const auto slip = [](int cells) {
    Solver s({.stress = [](double x) { return 0.2 + 0.1 * (1 - std::tanh(x)) / 2; },
              .forcing = {},
              .friction = friction::viscous(0.16),
              .left = -8,
              .right = 7,
              .corner = HUGE_VAL,
              .cells = cells});
    double integral = 0, before = 0;
    for (int i = 1; i <= 400; ++i) {  // Simpson's rule needs the middles too
      s.advance_to(2 * pi * (i - 0.5) / 400);
      const double middle = averages_of(s.view(), state_at(s.view(), 0), 0).W;
      s.advance_to(2 * pi * i / 400);
      const double after = averages_of(s.view(), state_at(s.view(), 0), 0).W;
      integral += 2 * pi / 400 / 6 * (before + 4 * middle + after);
      before = after;
    }
    EXPECT_NEAR(slip_at_origin(s) / integral, 1, cells == 100 ? 4e-3 : 3e-4) << cells;
    return slip_at_origin(s);
  };
  EXPECT_NEAR(slip(100) / 2.228e-8, 1, 3e-3);
  EXPECT_NEAR(slip(400) / 2.228e-8, 1, 5e-4);
}

TEST(UnderLoad, ForcedSparseTrainMovesLikeOneDislocation) {
  Solver s(forced(0.3, 2, 10, [](double, double) { return 0.05; }));
  s.advance_to(20);
  const double want = slip_of_uniform_train(0.3, 2, 20, [](double) { return 0.05; });
  EXPECT_NEAR(slip_at_origin(s) / want, 1, 1e-4);
}

TEST(UnderLoad, StepsFollowAForcingThatIsFasterThanTheWaves) {
  for (const double C : {0.0, 1.0}) {
    const auto F = [](double t) { return 0.05 * std::cos(5 * t); };
    Solver s(forced(0.2, C, 10, [&](double, double t) { return F(t); }));
    s.advance_to(12);
    const double want = slip_of_uniform_train(0.2, C, 12, F);
    EXPECT_NEAR(slip_at_origin(s), want, 1e-3 * std::fabs(want) + 1e-7) << C;
    // The energy that F has supplied is the dissipated plus the kinetic energy.
    const State now = state_at(s.view(), 0);
    const double energy = 20 * 0.2 / (2 * pi) * 8 * (std::cosh(now.phi) - 1);
    EXPECT_NEAR(s.supplied() - s.dissipated(), energy, 1e-3 * s.supplied() + 1e-7) << C;
  }
}

/// Compares two independent schemes on the same scenario: explicit steps with momenta in the cells, and implicit steps
/// with momenta at the faces. The size of the cells decides which one the solver uses.
TEST(UnderLoad, BothSchemesAgree) {
  double slip[2];
  for (const int i : {0, 1}) {
    Solver s({.stress = [](double x) { return 0.3 + 0.3 * (1 - std::tanh(x)) / 2; },
              .forcing = [](double x, double t) { return 0.01 * std::exp(-x * x) * std::sin(t); },
              .friction = friction::viscous(3),
              .left = -8,
              .right = 8,
              .corner = HUGE_VAL,
              .cells = i == 0 ? 150 : 2400});
    s.advance_to(2 * pi);
    EXPECT_EQ(s.cells().face_momentum.empty(), i == 1);
    slip[i] = slip_at_origin(s);
  }
  EXPECT_NEAR(slip[0] / slip[1], 1, 2e-3);
}

/// A law like w^(1/2) damps slow motion at an unlimited rate, so that no explicit step from rest is short enough. A
/// step with the slope of the law at the present speed makes creeping cells oscillate. The run once took 200,000 steps.
TEST(UnderLoad, FrictionSteepAtRestTakesFewSteps) {
  Problem p{.stress =
                [](double x) {
                  const double stress = 0.512 * std::exp(-std::pow((x - 0.0354) / 0.275, 2));
                  return stress < 0.0045 ? 0 : stress;
                },
            .forcing = [](double, double t) { return t < 1.52 ? 0.00142 : 0; },
            .friction = friction::power(16.2, 0.5),
            .left = -6.5,
            .right = 4.72,
            .corner = HUGE_VAL,
            .cells = 200};
  pulse::Run run(p, {.times = {0, 8.8}, .x_edges = {p.left, 0, p.right}});
  EXPECT_TRUE(run.go([&] { return run.solver().cells().steps > 2000; }));
}

/// A dense train under a load that changes its sign. The solver finds the slope of friction by differences that are
/// larger than the rounding error of the pressure. The run once took 16,000 steps to t = 0.1, when the load is 0.
TEST(UnderLoad, FrictionSteepAtRestFollowsALoadThatChangesSign) {
  Problem p = forced(1.5, 0, 10, [](double, double t) { return 0.0375 * std::cos(15.1 * t); });
  p.friction = friction::power(53, 0.5);
  p.cells = 50;
  pulse::Run run(p, {.times = {0, 0.15}, .x_edges = {p.left, 0, p.right}});
  EXPECT_TRUE(run.go([&] { return run.solver().cells().steps > 1500; }));
}

TEST(UnderLoad, FrictionSteepAtRestConverges) {
  const auto slip = [](int cells, friction::Closure closure) {
    Problem p{.stress = [](double x) { return x < 0 ? 0.855 : 0; },
              .forcing = {},
              .friction = friction::power(5.74, 0.5, closure),
              .left = -4.25,
              .right = 5.07,
              .cells = cells};
    pulse::Run run(p, {.times = {0, 2.83}, .x_edges = {p.left, 0, p.right}});
    run.go();
    const auto twice = run.slip_twice().value();
    EXPECT_LE(twice.error(), 1e-2 * std::fabs(twice.by_place)) << cells;
    return twice.by_place;
  };
  for (const friction::Closure closure : {friction::Closure::consistent, friction::Closure::paper})
    EXPECT_NEAR(slip(200, closure) / slip(400, closure), 1, 2e-3);
}

/// After a push, all cells slow down together and stop almost at the same time. Friction must then hold each cell. Once
/// it made cells oscillate, in steps that shrank with the remaining motion.
TEST(UnderLoad, DryFrictionHoldsCellsThatStopTogether) {
  Problem p;
  p.stress = [](double x) { return 0.303 + 0.041 * (1 - std::tanh(x / 1.23)) / 2; };
  p.forcing = [](double, double t) { return t < 0.314 ? -0.0543 : 0.0; };
  p.friction = friction::coulomb(0.00448, friction::Closure::paper);
  p.left = -6.07;
  p.right = 5.23;
  p.corner = HUGE_VAL;
  p.cells = 100;
  p.longest_step = 0.12;
  Solver s(p);
  s.advance_to(12);
  EXPECT_LT(s.cells().steps, 500);
  // The force pushes dislocations of mass 8 for 0.314, and then only dry friction acts. They move by this distance.
  const double gained = 2 * pi * (0.0543 - 0.00448) * 0.314 / 8, lost = 2 * pi * 0.00448 / 8;
  const double way = gained * 0.314 / 2 + gained * gained / (2 * lost);
  EXPECT_NEAR(s.slip_at(s.view(), 0) / (-way * 0.3235), 1, 5e-3);
}

}  // namespace
