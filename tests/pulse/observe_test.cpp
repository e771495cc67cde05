#include "averages/pulse/observe/observe.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "averages/pulse/solver.hpp"
#include "slipfront/averages/pulse/run.hpp"
#include "slipfront/error.hpp"
#include "slipfront/theory/modulation/modulation.hpp"
#include "slipfront/theory/rupture/relations.hpp"
#include "slipfront/theory/rupture/riemann.hpp"
#include "slipfront/theory/train.hpp"
#include "theory/modulation/equations.hpp"

namespace {

using namespace slipfront;
using namespace slipfront::pulse;
using std::numbers::pi;

Problem smooth(double C, friction::Closure closure) {
  return {.stress = [](double x) { return 0.179 + 0.676 * (1 - std::tanh(x)) / 2; },
          .forcing = {},
          .friction = friction::viscous(C, closure),
          .left = -8,
          .right = 6,
          .corner = HUGE_VAL,
          .cells = 400};
}

output::Schedule schedule(double end) {
  output::Schedule s{.times = {0, end}, .x_edges = {}, .threshold = 1e-3};
  for (int i = 0; i <= 200; ++i) s.x_edges.push_back(-8 + 14 * i / 200.0);
  return s;
}

/// Before a shock forms, the energy loss equals the dissipation. The imbalance is small compared with the dissipation.
TEST(Observe, EnergyBudgetClosesBeforeAShock) {
  for (const friction::Closure closure : {friction::Closure::consistent, friction::Closure::paper}) {
    Problem problem = smooth(0.5, closure);
    problem.cells = 800;
    pulse::Run run(problem, schedule(3));
    run.go();
    const output::Energy a = run.snapshots().front().energy, b = run.snapshots().back().energy;
    EXPECT_NEAR(a.kinetic, 0, 1e-14 * a.elastic);
    EXPECT_GT(b.dissipated, 1e-4);
    EXPECT_NEAR(a.elastic, b.elastic + b.kinetic + b.dissipated, 1e-3 * b.dissipated);
  }
}

/// This must hold even with few cells, when the slip velocity at x = 0 lies between the values of two nodes.
TEST(Observe, PeakIsNotBelowTheOrigin) {
  for (const int cells : {4, 5, 6, 7, 8})
    for (const double end : {1e-9, 1e-3, 0.1}) {
      Problem problem;
      problem.stress = [](double x) { return x < 0 ? 0.855 : 0; };
      problem.left = -6;
      problem.right = 4;
      problem.cells = cells;
      pulse::Run run(problem, schedule(end));
      run.go();
      const output::Snapshot& last = run.snapshots().back();
      EXPECT_GE(std::fabs(last.peak_slip_velocity), std::fabs(last.slip_velocity_at_origin)) << cells << " " << end;
    }
}

/// The peak of a hump that is narrower than a cell must not be lost. Next to such a hump, every cell counts as part of
/// a shock.
TEST(Observe, FindsThePeakOfANarrowPulse) {
  Problem problem{.stress = [](double x) { return 0.107 + 0.154 * std::exp(-std::pow((x + 0.834) / 0.242, 2)); },
                  .forcing = [](double, double) { return 0.00129; },
                  .friction = friction::viscous(0.184, friction::Closure::paper),
                  .left = -15.1,
                  .right = 17.8,
                  .corner = HUGE_VAL,
                  .cells = 100};
  pulse::Run run(problem, schedule(14.7));
  run.go();
  const Solver::View view = run.solver().view();
  double largest = 0;
  for (std::size_t i = 0; i < view.states.size(); ++i)
    largest = std::fmax(largest, std::fabs(averages_of(view, view.states[i], view.centres[i]).W));
  EXPECT_GT(std::fabs(run.snapshots().back().peak_slip_velocity), 0.8 * largest);
}

TEST(Observe, CountsDislocations) {
  pulse::Run run(smooth(0.1, friction::Closure::consistent), schedule(2 * pi));
  run.go();
  const double error = conservation_error(run.solver());  // this counts the states, so it is not zero
  EXPECT_GT(error, 1e-12);
  EXPECT_LT(error, 1e-4);  // a shock begins to form
  EXPECT_TRUE(run.warnings().empty());
}

/// The count does not telescope. If the states of cells and faces do not match, dislocations are missing.
TEST(Observe, ConservationErrorRevealsWrongCells) {
  Solver solver(smooth(0.1, friction::Closure::consistent));
  solver.advance_to(0.5);
  EXPECT_LT(conservation_error(solver), 1e-5);
  Cells broken = solver.cells();
  for (std::size_t i = 100; i < 300; i += 10) broken.values().width(i) *= 1.3;  // widths of some cells
  solver.restore(broken);
  EXPECT_GT(conservation_error(solver), 5e-4);
}

/// A train passes through the ends of the domain. The budget closes with the energy that the train outside brings in,
/// by its pressure and with its dislocations.
TEST(Observe, EnergyThroughTheEndsClosesTheBudget) {
  for (const double C : {0.0, 2.0}) {
    Problem p{.stress = [](double) { return 0.8; },
              .forcing = [](double, double) { return 0.05; },
              .friction = friction::viscous(C),
              .left = -4,
              .right = 4,
              .cells = 200};
    p.longest_step = 0.2;
    pulse::Run run(p, {.times = {0, 20}, .x_edges = {-4, 0, 4}});
    run.go();
    const output::Energy e = run.snapshots().back().energy;
    EXPECT_GT(e.through_ends, 0.1);
    EXPECT_NEAR(e.residual, 0, 1e-5 * e.supplied);
  }
}

/// The exact Riemann problem gives the energy that a shock takes: the jump of energy is larger than the flux through
/// it.
TEST(Observe, ShockTakesTheEnergyOfTheRiemannProblem) {
  Problem p{.stress = [](double x) { return x < 0 ? 3 : 0.5; },
            .forcing = {},
            .friction = {},
            .left = -8,
            .right = 8,
            .cells = 1600};
  const auto solution = rupture::solve_riemann(train::at_rest(3), train::at_rest(0.5));
  pulse::Run run(p, {.times = {0, 2, 4}, .x_edges = {-8, 0, 8}});
  run.go();
  const train::Averages behind = train::averages(solution.star), ahead = train::averages(solution.right);
  const double speed = rupture::edges_of(solution).right;
  // The energy flux through a surface that moves with the dislocations is p U; the surface itself carries H x_t.
  const double flux = modulation::pressure(solution.star.psi) * modulation::velocity(solution.star.phi) +
                      behind.H * (std::tanh(solution.star.phi) - speed) + ahead.H * speed;
  const double lost = (run.snapshots()[2].energy.residual - run.snapshots()[1].energy.residual) / 2;
  EXPECT_NEAR(lost, flux, 0.03 * flux);
}

/// A smooth stress has no corner where slip begins. The front is where the slip velocity is a thousandth of its peak,
/// for any number of cells. At rest there is no front.
TEST(Observe, TrailingFrontOfASmoothStressConverges) {
  const auto fronts = [](int cells) {
    Problem problem = smooth(0.5, friction::Closure::consistent);
    problem.cells = cells;
    pulse::Run run(problem, schedule(5));
    run.go();
    EXPECT_TRUE(std::isnan(run.snapshots().front().fronts.trailing));
    return run.snapshots().back().fronts.trailing;
  };
  const double fine = fronts(1600);
  EXPECT_NEAR(fronts(400), fine, 5e-3);
  EXPECT_NEAR(fronts(800), fine, 1e-3);
  EXPECT_LT(fine, -2);
}

/// The foot of a fan stays next to the characteristic, from the first few cells of the fan to the many that it fills
/// later.
TEST(Observe, TrailingFrontOfANarrowFanFollowsTheCharacteristic) {
  const double stresses[][2] = {{0.973, 1.94}, {0.703, 0.502}, {0.655, 1.06}, {0.4, 0.3}};
  for (const auto& both : stresses)
    for (const double C : {0.0, 0.3}) {
      const double left = both[0], right = both[1], sign = left > right ? -1 : 1, end = 1;
      Problem p{.stress = [left, right](double x) { return x < 0 ? left : right; },
                .forcing = {},
                .friction = friction::viscous(C),
                .left = -1.2,
                .right = 1.2,
                .cells = 100};
      output::Schedule when = schedule(end);
      for (double t = 0.15; t < end; t += 0.05) when.times.insert(when.times.end() - 1, t);
      pulse::Run run(p, when);
      run.go();
      const double cell = (p.right - p.left) / p.cells;
      for (const output::Snapshot& s : run.snapshots()) {
        if (s.time == 0) continue;
        const double ahead = sign * (s.fronts.trailing - s.fronts.trailing_characteristic);
        EXPECT_LT(ahead, 2 * cell) << left << " " << right << " " << C << " " << s.time;
        EXPECT_GT(ahead, -2 * cell) << left << " " << right << " " << C << " " << s.time;
      }
    }
}

/// The trailing edge moves at |V-| for every C. An observer with a threshold sees a slower edge.
TEST(Observe, TrailingEdgeDoesNotDependOnFriction) {
  for (const double C : {0.0, 0.5, 2.0}) {
    Problem p{.stress = [](double x) { return x < 0 ? 0.855 : 0.0; },
              .forcing = {},
              .friction = friction::viscous(C),
              .left = -3,
              .right = 1,
              .cells = 200};
    output::Schedule when = schedule(2 * pi);
    when.threshold = 0.1;
    pulse::Run run(p, when);
    run.go();
    const output::Fronts f = run.snapshots().back().fronts;
    const double characteristic = -rupture::from_stress(0.855).rupture_velocity * 2 * pi;
    EXPECT_NEAR(f.trailing_characteristic, characteristic, 1e-12);
    // The measured front is within two cells of it as long as the foot, which falls as e^(-C t / 2), is above a
    // thousandth.
    EXPECT_NEAR(f.trailing, characteristic, 0.02) << C;
    EXPECT_GT(f.trailing_observed, f.trailing);
    // The value without friction is the closed form. Those with friction come from an older, first-order scheme.
    const double frictionless = rupture::from_stress(0.855).leading_velocity * 2 * pi;
    const double leading = C == 0 ? frictionless : C == 0.5 ? 0.286 : 0.15;
    EXPECT_NEAR(f.leading, leading, 0.005);
  }
}

/// A problem with the stress on the right is the mirror image of one with the stress on the left.
TEST(Observe, MirroredScenarioHasMirroredFronts) {
  for (const double right : {0.0, 0.179}) {
    Problem p = smooth(0.3, friction::Closure::consistent), mirrored = p;
    p.left = mirrored.left = -4;
    p.right = mirrored.right = 4;
    p.cells = mirrored.cells = 200;
    p.stress = [right](double x) { return x < 0 ? 0.855 : right; };
    mirrored.stress = [right](double x) { return x > 0 ? 0.855 : right; };
    pulse::Run run(p, schedule(2)), mirror(mirrored, schedule(2));
    run.go();
    mirror.go();
    const output::Fronts a = run.snapshots().back().fronts, b = mirror.snapshots().back().fronts;
    EXPECT_LT(a.trailing, -0.7);
    EXPECT_NEAR(a.trailing, -b.trailing, 1e-9);
    EXPECT_NEAR(a.leading, -b.leading, 1e-9);
    // Observed fronts are where W is a thousandth of its peak. Rounding moves them more, as cells are counted from the
    // left.
    EXPECT_NEAR(a.trailing_observed, -b.trailing_observed, 1e-7);
    EXPECT_NEAR(a.leading_observed, -b.leading_observed, 1e-7);
  }
}

/// With free ends, too, fronts are named by the side with the larger stress at the start.
TEST(Observe, MirroredScenarioWithFreeEndsHasMirroredFronts) {
  Problem p = smooth(0.5, friction::Closure::consistent);
  p.left = -1;
  p.right = 1;
  p.cells = 100;
  p.left_end = p.right_end = pulse::End::free;
  Problem mirrored = p;
  const auto stress = [](double x) { return 0.6 - 0.3 * std::tanh(x / 0.1); };
  p.stress = stress;
  mirrored.stress = [stress](double x) { return stress(-x); };
  pulse::Run run(p, schedule(0.5)), mirror(mirrored, schedule(0.5));
  run.go();
  mirror.go();
  const output::Fronts a = run.snapshots().back().fronts, b = mirror.snapshots().back().fronts;
  EXPECT_FALSE(std::isnan(a.leading_observed) && std::isnan(a.trailing_observed));
  const auto expect_mirrored = [](double x, double y) {
    EXPECT_EQ(std::isnan(x), std::isnan(y));
    if (!std::isnan(x)) {
      EXPECT_NEAR(x, -y, 1e-7);
    }
  };
  expect_mirrored(a.leading_observed, b.leading_observed);
  expect_mirrored(a.trailing_observed, b.trailing_observed);
  expect_mirrored(a.leading, b.leading);
}

TEST(Observe, FrontsDoNotDependOnOutputTimes) {
  output::Schedule often = schedule(2);
  for (double t = 1.9; t > 0.05; t -= 0.1) often.times.insert(often.times.begin() + 1, t);
  pulse::Run rarely(smooth(0.5, friction::Closure::consistent), schedule(2)),
      closely(smooth(0.5, friction::Closure::consistent), often);
  rarely.go();
  closely.go();
  const output::Fronts a = rarely.snapshots().back().fronts, b = closely.snapshots().back().fronts;
  EXPECT_NEAR(a.trailing, b.trailing, 1e-3);
  EXPECT_NEAR(a.leading, b.leading, 1e-6);
}

/// In a nonuniform state, the solver evaluates the state at the front between steps. That must not change later solves.
TEST(Run, SavedBetweenStepsContinuesToTheSameBits) {
  for (const double C : {0.3, 1e4}) {
    Problem problem = smooth(C, friction::Closure::consistent);
    problem.cells = 60;
    pulse::Run whole(problem, schedule(2));
    whole.go();
    for (const int steps : {1, 2, 3}) {
      pulse::Run cut(problem, schedule(2));
      int left = steps;
      EXPECT_FALSE(cut.go([&] { return --left == 0; }));
      pulse::Run resumed(problem, schedule(2), cut.saved(), cut.snapshots());
      EXPECT_TRUE(resumed.go());
      EXPECT_EQ(whole.saved(), resumed.saved()) << C << ", " << steps;
    }
  }
}

TEST(Run, RefusesStateOfAnotherRun) {
  const output::Schedule when = schedule(1);
  pulse::Run run(smooth(0.5, friction::Closure::consistent), when);
  run.go();
  const std::string saved = run.saved();
  Problem other = smooth(0.5, friction::Closure::consistent);
  other.cells = 300;
  EXPECT_THROW(pulse::Run(other, when, saved, {}), InputError);
  EXPECT_THROW(pulse::Run(smooth(0.5, {}), when, saved.substr(0, saved.size() / 2), {}), InputError);
  EXPECT_THROW(pulse::Run(smooth(0.5, {}), when, "", {}), InputError);
  const pulse::Run again(smooth(0.5, friction::Closure::consistent), when, saved, run.snapshots());
  EXPECT_TRUE(again.finished());
}

/// A force pushes the train out of the domain. There is nothing left to measure.
TEST(Observe, EmptyDomainHasNoPeakAndNoFronts) {
  Problem p;
  p.stress = [](double x) { return std::fabs(x) < 0.5 ? 0.8 : 0.0; };
  p.forcing = [](double, double) { return 0.5; };
  p.left = -2;
  p.right = 2;
  p.cells = 30;
  pulse::Run run(p, {.times = {0, 12}, .x_edges = {-2, 0, 2}});
  ASSERT_TRUE(run.go());
  ASSERT_GT(run.solver().cells().left_edge(), 2);
  const output::Snapshot& s = run.snapshots().back();
  EXPECT_EQ(s.peak_slip_velocity, 0);
  EXPECT_TRUE(std::isnan(s.peak_position));
  EXPECT_TRUE(std::isnan(s.fronts.trailing_observed));
  EXPECT_TRUE(std::isnan(s.fronts.leading_observed));
}

}  // namespace
