// Empty gaps between stressed blocks, whose free edges meet.

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "averages/pulse/solver.hpp"
#include "slipfront/averages/pulse/run.hpp"
#include "slipfront/error.hpp"
#include "slipfront/theory/rupture/relations.hpp"
#include "slipfront/theory/train.hpp"

namespace {

using namespace slipfront;
using namespace slipfront::pulse;
using std::numbers::pi;

Problem two_sides(double gap, int cells, double C = 0) {
  return {.stress = [=](double x) { return std::fabs(x) > gap / 2 ? 0.855 : 0.0; },
          .forcing = {},
          .friction = friction::viscous(C),
          .left = -4,
          .right = 4,
          .corner = HUGE_VAL,
          .cells = cells};
}

/// Until they meet, both sides move as if there were only one.
TEST(Gap, SidesAreIndependentUntilTheyMeet) {
  const auto alone = rupture::from_stress(0.855);
  Solver s(two_sides(1, 200));
  const double t = 0.45 / alone.leading_velocity;
  s.advance_to(t);
  EXPECT_EQ(s.size(), 201);
  const auto view = s.view();
  EXPECT_TRUE(state_at(view, 0).empty());
  for (const double side : {-1.0, 1.0}) {
    const State at = state_at(view, side * 0.5);
    EXPECT_NEAR(train::averages(at).W / (-side * alone.slip_velocity), 1, 1e-3);
  }
}

/// In a gap, the contact has nothing to act on. A slope of the contact moves each edge as it moves that of a single
/// side.
TEST(Gap, SidesOnASlopeOfTheContactAreIndependent) {
  Problem both = two_sides(1, 200);
  both.contact = [](double x) { return 1 + 0.1 * std::tanh(x); };
  Problem left = both;
  left.stress = [](double x) { return x < -0.5 ? 0.855 : 0.0; };
  left.cells = 100;
  Solver with(both), without(left);
  with.advance_to(1);
  without.advance_to(1);
  EXPECT_LT(with.cells().steps, 200);
  EXPECT_NEAR(with.slip_at(with.view(), -0.5), without.slip_at(without.view(), -0.5), 1e-4);
}

TEST(Gap, ClosesWithASymmetricCollision) {
  const auto after = [](int cells) {
    Solver s(two_sides(0.4, cells));
    s.advance_to(2 * pi);
    EXPECT_LE(s.size(), static_cast<std::size_t>(cells));
    EXPECT_LT(s.cells().steps, cells);  // small cells at the edges limit the steps only for a short time
    double charge = 0;
    for (const double q : s.charge()) charge += q;
    EXPECT_NEAR(charge, 7.6 * 0.855 / (2 * pi), 1e-12);
    const auto view = s.view();
    for (const double x : {0.1, 0.3, 1.0, 2.0}) {
      EXPECT_NEAR(state_at(view, x).psi, state_at(view, -x).psi, 1e-6);
      EXPECT_NEAR(state_at(view, x).phi, -state_at(view, -x).phi, 1e-6);
    }
    return train::averages(state_at(view, 0)).k;
  };
  EXPECT_NEAR(after(100), after(400), 1e-3);
  EXPECT_NEAR(after(200), after(400), 3e-4);
}

TEST(Gap, ClosesUnderStrongFrictionToo) {
  const auto after = [](int cells) {
    Solver s(two_sides(0.4, cells, 1e3));
    s.advance_to(1e4);
    EXPECT_LE(s.size(), static_cast<std::size_t>(cells));
    return train::averages(state_at(s.view(), 0)).k;
  };
  EXPECT_NEAR(after(100), after(400), 2e-3);
}

/// The train next to a free edge is no denser than in the adjacent cells. Rounding may decide which of two cells is
/// adjacent, so we check that a mirrored problem has the same peak.
TEST(Gap, PeakNextToTheEdgesIsTheSameInAMirroredProblem) {
  const auto peak = [](double sign) {
    Problem p{.stress = [=](double x) { return std::fabs(sign * x - 0.113) < 1.11 ? 0 : 0.159; },
              .forcing = [=](double, double) { return sign * 0.0359; },
              .friction = friction::viscous(0.0211),
              .left = sign > 0 ? -2.04 : -1.75,
              .right = sign > 0 ? 1.75 : 2.04,
              .corner = HUGE_VAL,
              .cells = 100};
    pulse::Run run(p, {.times = {0, 0.549}, .x_edges = {p.left, 0, p.right}});
    run.go();
    return sign * run.snapshots().back().peak_slip_velocity;
  };
  EXPECT_NEAR(peak(-1) / peak(1), 1, 2e-5);
}

/// Linear interpolation between points (x, stress).
struct Points {
  std::vector<double> x, stress;
  double operator()(double at) const {
    for (std::size_t i = 1; i < x.size(); ++i)
      if (at <= x[i]) return std::lerp(stress[i - 1], stress[i], (at - x[i - 1]) / (x[i] - x[i - 1]));
    return stress.back();
  }
};

/// Linear interpolation between random points, with some empty regions.
Points random_points(std::mt19937& chance) {
  const auto between = [&](double low, double high) { return std::uniform_real_distribution<>(low, high)(chance); };
  Points points{{-3.6}, {chance() % 4 == 0 ? 0.0 : 1.2}};
  while (points.x.back() < 3.6) {
    const bool empty = points.stress.back() == 0;
    points.x.push_back(points.x.back() + between(0.02, 1.5));
    points.stress.push_back(!empty && chance() % 2 == 0 ? 0 : between(0.1, 1.4));
  }
  return points;
}

/// Checks that widths are positive, and that the dislocations are those at t = 0 and those that entered.
void expect_sound(const Solver& s, double at_first) {
  double charge = 0;
  for (std::size_t i = 0; i < s.size(); ++i) {
    charge += s.charge()[i];
    if (s.charge()[i] > 0) {
      EXPECT_GT(s.cells().width(i), 0);
    }
  }
  const double entered = s.cells().entered_left + s.cells().entered_right;
  EXPECT_NEAR(charge, at_first + entered, 1e-9 * (at_first + std::fabs(entered)));
  EXPECT_GT(s.charge().front(), 0);
  EXPECT_GT(s.charge().back(), 0);
}

/// Few cells remain when gaps have closed, so the joining of small cells may reach the first and the last cell.
TEST(Gap, ConservesDislocationsWithFewCellsAndEveryKindOfEnd) {
  std::mt19937 chance(26);
  constexpr std::array<End, 3> ends{End::continued, End::fixed, End::free};
  int ran = 0, closed = 0;
  for (int i = 0; i < 200; ++i) {
    Problem p{
        .stress = random_points(chance), .forcing = {}, .friction = friction::viscous(0), .left = -3.5, .right = 3.5};
    p.corner = HUGE_VAL;
    p.friction = i % 3 == 0 ? friction::coulomb(0.01) : i % 3 == 1 ? friction::viscous(0.1) : friction::viscous(0);
    p.left_end = ends[chance() % 3];
    p.right_end = ends[chance() % 3];
    p.cells = 4 + static_cast<int>(chance() % 9);
    const double end = 0.5 + static_cast<double>(chance() % 6);
    try {
      Solver s(p);
      double at_first = 0;
      for (const double q : s.charge()) at_first += q;
      const std::size_t cells = s.size();
      s.advance_to(end);
      ++ran;
      closed += s.size() < cells ? 1 : 0;
      expect_sound(s, at_first);
    } catch (const InputError&) {  // an end has no stress
    } catch (const NumericsError&) {
    }
  }
  EXPECT_GT(ran, 150);
  EXPECT_GT(closed, 15);
}

/// All cells to the left of a closed gap are small, so joining them reaches the first cell.
TEST(Gap, JoinsUpToTheFirstCell) {
  const Points points{{-4, -2.532701194467415, -2.4726732772599416, -0.6367292433644893, -0.49426282527591114,
                       -0.48891112430626826, 1.1153443564011116, 1.9799118410055883, 4},
                      {0, 0, 0, 0.0046, 0, 1.2, 0.0046, 0.3, 0}};
  for (const End right : {End::fixed, End::free, End::continued}) {
    Solver s({.stress =
                  [=](double x) {
                    const double f = points(x);
                    return f < 0.0045 ? 0 : f;
                  },
              .forcing = {},
              .friction = friction::coulomb(0.01),
              .left = -3.5,
              .right = 3.5,
              .corner = HUGE_VAL,
              .left_end = End::fixed,
              .right_end = right,
              .cells = 6});
    double at_first = 0;
    for (const double q : s.charge()) at_first += q;
    const std::size_t cells = s.size();
    s.advance_to(2);
    EXPECT_LT(s.size(), cells);
    expect_sound(s, at_first);
  }
}

TEST(Gap, ResumedRunHasTheSameBits) {
  const Problem p = two_sides(0.4, 60, 0.3);
  for (const double t : {0.5, 4.0}) {  // before and after the edges have met
    Solver whole(p);
    whole.advance_to(t);
    whole.advance_to(6);
    Solver cut(p);
    cut.advance_to(t);
    Solver resumed(p);
    resumed.restore(cut.cells());
    resumed.advance_to(6);
    EXPECT_EQ(whole.cells().unknowns, resumed.cells().unknowns);
  }
}

TEST(Gap, ProfileIsZeroInTheGap) {
  std::vector<double> edges;
  for (int i = -40; i <= 40; ++i) edges.push_back(i * 0.1);
  pulse::Run run(two_sides(1, 100), {.times = {0, 0.5}, .x_edges = edges});
  run.go();
  const output::Profile& profile = run.snapshots().back().profile;
  EXPECT_EQ(profile.k[40], 0);
  EXPECT_EQ(profile.W[40], 0);
  EXPECT_EQ(profile.slip[40], 0);
  EXPECT_GT(profile.W[34], 0);
  EXPECT_LT(profile.W[45], 0);
  double counted = 0;
  for (const double k : profile.k) counted += k * 0.1 / (2 * std::numbers::pi);
  const double left = charge_left_of(run.solver().view(), edges.front());
  const double right = charge_left_of(run.solver().view(), edges.back());
  EXPECT_NEAR(counted, right - left, 1e-12);
}

/// A gap has no energy. Where two trains without friction meet, streams cross, and half of the kinetic energy is lost
/// (docs/pulse.md). With friction, most of the motion stops before.
TEST(Gap, StreamsThatCrossAreReportedAndLoseEnergy) {
  for (const double C : {0.0, 0.3}) {
    Problem p = two_sides(0.6, 200);
    if (C > 0) p.friction = friction::viscous(C);
    std::vector<double> edges{p.left, 0, p.right};
    pulse::Run run(p, {.times = {0, 2, 10}, .x_edges = edges});
    run.go();
    const output::Energy before = run.snapshots()[1].energy, after = run.snapshots()[2].energy;
    EXPECT_NEAR(before.residual, 0, 2e-2 * (before.kinetic + before.dissipated));
    const double motion = after.kinetic + after.dissipated + after.residual;
    const double time = run.solver().cells().crossing_time;
    EXPECT_GT(time, 2.5);
    EXPECT_LT(std::fabs(run.solver().cells().crossing_position), 0.2);
    if (C == 0) {
      EXPECT_GT(after.residual, 0.2 * motion);
      ASSERT_EQ(run.warnings().size(), 1U);
      EXPECT_NE(run.warnings()[0].find("overtake"), std::string::npos);
    } else {
      EXPECT_LT(after.residual, 0.05 * motion);
      EXPECT_TRUE(run.warnings().empty());
    }
  }
}

}  // namespace
