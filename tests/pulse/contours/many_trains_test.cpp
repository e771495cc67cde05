// Several trains at one position: steps against the exact Riemann problem, smooth stress against one train before
// dislocations overtake each other, invariants and symmetry behind that.
#include "averages/pulse/contours/many_trains.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "averages/pulse/one_train.hpp"
#include "averages/pulse/solver.hpp"
#include "slipfront/averages/pulse/run.hpp"
#include "slipfront/error.hpp"
#include "slipfront/theory/rupture/riemann_trains.hpp"
#include "slipfront/theory/rupture/trains.hpp"
#include "slipfront/theory/train.hpp"

namespace {

using namespace slipfront;
using pulse::Contour;
using pulse::ManyTrains;
using pulse::Problem;

Problem smooth_problem(std::function<double(double)> stress, double half_width, int cells) {
  return {.stress = std::move(stress),
          .forcing = {},
          .friction = {},
          .left = -half_width,
          .right = half_width,
          .corner = HUGE_VAL,
          .cells = cells,
          .many_trains = true};
}

Problem step_problem(double left, double right, int cells) {
  Problem p = smooth_problem([=](double x) { return x < 0 ? left : right; }, 3, cells);
  p.corner = 0;
  return p;
}

output::Schedule schedule_to(const Problem& p, double end) {
  output::Schedule schedule{.times = {0, end}, .x_edges = {}};
  for (int i = 0; i <= p.cells; ++i) schedule.x_edges.push_back(p.left + (p.right - p.left) * i / p.cells);
  return schedule;
}

output::Snapshot end_of_motion(const Problem& p, double end) {
  ManyTrains trains(p);
  trains.advance_to(end, [] { return false; });
  return trains.observe(schedule_to(p, end));
}

output::Snapshot end_of_run(const Problem& p, double end) {
  pulse::Run run(p, schedule_to(p, end));
  run.go();
  return run.snapshots().back();
}

double falling(double x) { return 0.4 + 0.63 * (1 - std::tanh(x / 0.3)) / 2; }
double hump(double x) { return 0.5 + 0.6 * std::exp(-x * x / 0.16); }

TEST(ManyTrains, StepsAreTheExactRiemannProblem) {
  for (const auto& [left, right] : {std::pair{0.855, 0.0}, {0.855, 0.179}, {1.03, 0.4}, {0.606, 0.3}, {0.3, 0.9}}) {
    const Problem p = step_problem(left, right, 200);
    const double end = 2;
    const output::Snapshot s = end_of_motion(p, end);
    const auto exact = rupture::solve_trains(train::at_rest(left), train::at_rest(right));
    const rupture::Edges edges = rupture::edges_of(exact);
    const double fast = left > right ? edges.left : edges.right, slow = left > right ? edges.right : edges.left;
    EXPECT_NEAR(s.fronts.trailing, end * fast, 1e-9);
    EXPECT_NEAR(s.fronts.leading, end * slow, 1e-9);
    EXPECT_NEAR(s.slip_velocity_at_origin, rupture::profile_point(exact, 0).all.W, 1e-6);
    const std::vector<double> edges_of_cells = schedule_to(p, end).x_edges;
    double off = 0, all = 0;
    for (std::size_t i = 0; i < s.profile.slip.size(); ++i) {
      const double x = (edges_of_cells[i] + edges_of_cells[i + 1]) / 2;
      const rupture::TrainsPoint at = rupture::profile_point(exact, x / end);
      off += std::fabs(s.profile.slip[i] - end * at.slip);
      all += std::fabs(end * at.slip);
      if (std::fabs(x - s.fronts.leading) > 0.01 && std::fabs(x - s.fronts.trailing) > 0.01) {
        EXPECT_NEAR(s.profile.W[i], at.all.W, 1e-3 * std::fabs(s.peak_slip_velocity)) << x;
        EXPECT_EQ(s.profile.trains[i], static_cast<double>(at.trains.size())) << x;
      }
    }
    EXPECT_LT(off / all, 1e-4) << left << " " << right;
  }
}

TEST(ManyTrains, EqualOneTrainBeforeDislocationsOvertakeEachOther) {
  Problem p = smooth_problem(falling, 3, 400);
  const double end = 1.2;  // they do from t = 1.6 on
  const output::Snapshot many = end_of_motion(p, end);
  p.many_trains = false;
  pulse::Run run(p, schedule_to(p, end));
  run.go();
  const output::Snapshot& one = run.snapshots().back();
  EXPECT_NEAR(many.slip_at_origin / one.slip_at_origin, 1, 2e-4);
  EXPECT_NEAR(many.slip_velocity_at_origin / one.slip_velocity_at_origin, 1, 2e-4);
  EXPECT_NEAR(many.energy.kinetic / one.energy.kinetic, 1, 1e-3);
  EXPECT_NEAR(many.energy.elastic / one.energy.elastic, 1, 1e-4);
  EXPECT_NEAR(many.fronts.trailing_characteristic, one.fronts.trailing_characteristic, 1e-3);
  EXPECT_NEAR(many.fronts.trailing, one.fronts.trailing, 0.02);
  EXPECT_NEAR(many.fronts.leading, one.fronts.leading, 0.01);
  EXPECT_NEAR(many.peak_position, one.peak_position, 0.02);
  for (std::size_t i = 0; i < many.profile.k.size(); ++i) {
    EXPECT_NEAR(many.profile.k[i], one.profile.k[i], 2e-3);
    EXPECT_NEAR(many.profile.slip[i], one.profile.slip[i], 2e-4);
    EXPECT_EQ(many.profile.trains[i], 1);
  }
}

TEST(ManyTrains, KeepDislocationsAndEnergyWhereTheyFold) {
  const Problem p = smooth_problem(falling, 4, 400);
  pulse::Run run(p, schedule_to(p, 4));
  ASSERT_TRUE(run.go());
  EXPECT_TRUE(run.warnings().empty());
  EXPECT_LT(run.conservation_error(), 1e-4);
  const output::Snapshot& s = run.snapshots().back();
  EXPECT_EQ(*std::max_element(s.profile.trains.begin(), s.profile.trains.end()), 2);
  EXPECT_LT(std::fabs(s.energy.residual), 0.02 * s.energy.kinetic);
  EXPECT_LT(std::fabs(s.profile.slip.back()), 1e-4 * s.slip_at_origin);  // nothing moves ahead of the front
  EXPECT_TRUE(std::isnan(run.crossing_time()));
  const double chain = 0.25884;  // every dislocation, scale 5000
  EXPECT_NEAR(s.slip_at_origin / chain, 1, 1e-3);
}

TEST(ManyTrains, ConvergeWithThePoints) {
  double before = 0, last = 0;
  for (const int cells : {100, 200, 400}) {
    const double slip = end_of_motion(smooth_problem(falling, 4, cells), 4).slip_at_origin;
    if (cells == 200) before = std::fabs(slip - last);
    if (cells == 400) {
      EXPECT_LT(std::fabs(slip - last), before / 2);
    }
    last = slip;
  }
}

TEST(ManyTrains, AreMirrorImagesOfEachOther) {
  const output::Snapshot symmetric = end_of_motion(smooth_problem(hump, 3, 200), 3);
  const std::vector<double>& slip = symmetric.profile.slip;
  for (std::size_t i = 0; i < slip.size(); ++i) EXPECT_NEAR(slip[i], -slip[slip.size() - 1 - i], 1e-5);
  const output::Snapshot left = end_of_motion(smooth_problem(falling, 4, 200), 3);
  const output::Snapshot right = end_of_motion(smooth_problem([](double x) { return falling(-x); }, 4, 200), 3);
  EXPECT_NEAR(left.slip_at_origin, -right.slip_at_origin, 1e-4 * left.slip_at_origin);
  EXPECT_NEAR(left.fronts.trailing_characteristic, -right.fronts.trailing_characteristic, 1e-9);
}

TEST(ManyTrains, OfSeparateStretchesMeet) {
  const Problem p = smooth_problem([](double x) { return std::fabs(x) < 0.3 ? 0.0 : 0.8; }, 4, 200);
  const output::Snapshot early = end_of_motion(p, 1), late = end_of_motion(p, 8);
  const std::size_t middle = early.profile.trains.size() / 2;
  EXPECT_EQ(early.profile.trains[middle], 0);
  EXPECT_EQ(late.profile.trains[middle], 2);
  const double fastest = std::tanh(train::psi_of_stress(0.8));
  EXPECT_NEAR(early.stress_at_origin, 0, 0);
  EXPECT_NEAR(end_of_motion(p, 0.3 / fastest - 0.01).stress_at_origin, 0, 0);
  EXPECT_GT(end_of_motion(p, 0.3 / fastest + 0.01).stress_at_origin, 0.1);
}

TEST(ManyTrains, LeaveThroughAFreeEnd) {
  Problem p = smooth_problem([](double) { return 0.8; }, 2, 200);
  p.right_end = pulse::End::free;
  const output::Snapshot s = end_of_motion(p, 2);
  const auto exact = rupture::solve_trains(train::at_rest(0.8), {});
  EXPECT_TRUE(std::isnan(s.fronts.leading));  // it has left the domain
  const double x = 2 - 2.0 / p.cells;
  EXPECT_NEAR(s.profile.slip.back(), 2 * rupture::profile_point(exact, (x - 2) / 2).slip, 1e-5);
  EXPECT_LT(s.energy.through_ends, 0);
  EXPECT_NEAR(s.energy.residual, 0, 1e-6);
}

TEST(ManyTrains, OfUniformStressRest) {
  const output::Snapshot s = end_of_motion(smooth_problem([](double) { return 0.8; }, 2, 50), 3);
  for (std::size_t i = 0; i < s.profile.slip.size(); ++i) {
    EXPECT_NEAR(s.profile.slip[i], 0, 1e-14);
    EXPECT_NEAR(s.profile.W[i], 0, 1e-14);
    EXPECT_NEAR(s.profile.k[i], 0.8, 1e-12);
  }
}

TEST(ManyTrains, AreSlowAtSmallStress) {
  const Problem p = smooth_problem([](double x) { return 0.1 + 0.1 * (1 - std::tanh(x)) / 2; }, 4, 200);
  const double end = 1e6;
  const output::Snapshot s = end_of_motion(p, end);
  const auto exact = rupture::solve_trains(train::at_rest(0.2), train::at_rest(0.1));
  EXPECT_GT(s.slip_velocity_at_origin, 0);
  EXPECT_LT(s.slip_velocity_at_origin, 2 * rupture::profile_point(exact, 0).all.W);
}

TEST(ManyTrains, NeedStress) {
  EXPECT_THROW(ManyTrains(smooth_problem([](double) { return 0.0; }, 1, 50)), InputError);
}

void expect_the_same_bits_after_each_step(const Problem& p) {
  output::Schedule schedule = schedule_to(p, 4);
  schedule.times = {0, 2.5, 4};
  pulse::Run whole(p, schedule);
  ASSERT_TRUE(whole.go());
  pulse::Run parts(p, schedule);
  while (!parts.go([] { return true; })) parts = pulse::Run(p, schedule, parts.saved(), parts.snapshots());
  EXPECT_EQ(parts.saved(), whole.saved());
  EXPECT_EQ(parts.snapshots().back().slip_at_origin, whole.snapshots().back().slip_at_origin);
  EXPECT_EQ(parts.steps(), whole.steps());
  output::Schedule first = schedule;
  first.times = {0, 2.5, 3.1};
  pulse::Run begun(p, first);
  ASSERT_TRUE(begun.go());
  std::vector<output::Snapshot> common(begun.snapshots().begin(), begun.snapshots().begin() + 2);
  pulse::Run later(p, schedule, begun.saved(), common);
  ASSERT_TRUE(later.go());
  EXPECT_EQ(later.saved(), whole.saved());
}

TEST(ManyTrains, ResumeWithTheSameBits) {
  const Problem p = smooth_problem(falling, 4, 100);
  expect_the_same_bits_after_each_step(p);
  const output::Schedule schedule = schedule_to(p, 1);
  pulse::Run whole(p, schedule);
  ASSERT_TRUE(whole.go());
  Problem one = p;
  one.many_trains = false;
  EXPECT_THROW(pulse::Run(one, schedule, whole.saved(), {}), InputError);
  pulse::Run of_one(one, schedule);
  EXPECT_THROW(pulse::Run(p, schedule, of_one.saved(), {}), InputError);
}

/// Every vertical line crosses the curves at the edges of bands, and at t = 0 at those of the train at rest.
TEST(Contours, HaveTheEdgesOfTheTrainsAtRest) {
  const Contour contour = pulse::contour_at_rest(smooth_problem(hump, 3, 200));
  std::vector<double> x;
  for (int i = 0; i <= 1000; ++i) x.push_back(-5 + 0.01 * i);
  pulse::Sweep(contour).at(x, [&](std::size_t i, const std::vector<double>& edges) {
    ASSERT_EQ(edges.size(), 2);
    EXPECT_NEAR(edges[0] / edges[1], -1, 1e-3);
    EXPECT_NEAR(train::stress_at_rest(edges[1]), hump(std::clamp(x[i], -3.0, 3.0)), 6e-4) << x[i];
  });
}

TEST(Contours, AreCrossedInPairs) {
  ManyTrains trains(smooth_problem([](double x) { return 1.1 - 0.6 * std::exp(-x * x / 0.16); }, 4, 200));
  trains.advance_to(3, [] { return false; });
  std::size_t most = 0;
  pulse::Sweep sweep(trains.contour());
  sweep.at_points([&](std::size_t point, const std::vector<double>& edges, std::size_t own) {
    EXPECT_EQ(edges.size() % 2, 0);
    EXPECT_EQ(edges[own], trains.contour().r[point]);
    EXPECT_TRUE(std::is_sorted(edges.begin(), edges.end()));
    most = std::max(most, edges.size());
  });
  EXPECT_EQ(most, 6);  // two pulses have met: three trains
}

/// Friction and a load, before dislocations overtake each other: the solver of one train is another method.
TEST(ManyTrains, FollowFrictionAndLoadAsOneTrainDoes) {
  Problem p = smooth_problem(falling, 4, 400);
  p.friction = friction::viscous(0.2);
  p.forcing = [](double x, double t) { return 0.05 * std::exp(-x * x) * std::cos(t) + 0.01; };
  const output::Snapshot many = end_of_motion(p, 1);
  p.many_trains = false;
  pulse::Run run(p, schedule_to(p, 1));
  run.go();
  const output::Snapshot& one = run.snapshots().back();
  EXPECT_NEAR(many.slip_at_origin, one.slip_at_origin, 2e-4 * one.slip_at_origin);
  EXPECT_NEAR(many.slip_velocity_at_origin, one.slip_velocity_at_origin, 2e-4 * one.slip_velocity_at_origin);
  EXPECT_NEAR(many.energy.dissipated, one.energy.dissipated, 5e-3 * one.energy.dissipated);
  EXPECT_NEAR(many.energy.supplied, one.energy.supplied, 5e-3 * one.energy.supplied);
  for (std::size_t i = 0; i < one.profile.slip.size(); ++i)
    EXPECT_NEAR(many.profile.slip[i], one.profile.slip[i], 5e-4 * one.slip_at_origin) << i;
}

/// A chain of scale 5000 has the slip 0.21244 and W = 0.05746 at x = 0, one train with shocks 0.21631 and 0.05875.
TEST(ManyTrains, SlowDownUnderViscousFrictionAsTheChainDoes) {
  Problem p = smooth_problem(falling, 5, 200);
  p.friction = friction::viscous(0.2);
  const output::Snapshot end = end_of_motion(p, 4);
  EXPECT_NEAR(end.slip_at_origin, 0.21244, 1e-3);
  EXPECT_NEAR(end.slip_velocity_at_origin, 0.05746, 1e-4);
  EXPECT_EQ(*std::max_element(end.profile.trains.begin(), end.profile.trains.end()), 2);
  EXPECT_LT(std::fabs(end.energy.residual), 0.03 * end.energy.kinetic);
}

/// Behind a fast front that has left the domain, friction changes both edges. Once W became negative there.
TEST(ManyTrains, HaveFrictionBehindAFrontThatLeavesTheDomain) {
  Problem small = smooth_problem(falling, 3, 240), large = smooth_problem(falling, 6, 480);
  small.friction = large.friction = friction::viscous(0.2);
  const output::Snapshot in_small = end_of_motion(small, 4), in_large = end_of_motion(large, 4);
  for (std::size_t i = 0; i < 240; ++i)
    EXPECT_NEAR(in_small.profile.W[i], in_large.profile.W[120 + i], 2e-4 + 0.005 * in_large.profile.W[120 + i]) << i;
  EXPECT_GE(*std::min_element(in_small.profile.W.begin(), in_small.profile.W.end()), -2e-4);
}

/// The first step was once so long that friction carried rapidities out of their range.
TEST(ManyTrains, BeginWithStepsThatStrongFrictionAllows) {
  Problem p = smooth_problem(falling, 5, 50);
  p.friction = friction::viscous(1e4);
  const double end = 1e-3;
  EXPECT_NEAR(end_of_motion(p, end).slip_velocity_at_origin, 5e-6, 2e-6);  // many trains end at 4 / C
  const output::Snapshot many = end_of_run(p, end);
  p.many_trains = false;
  const output::Snapshot one = end_of_run(p, end);
  EXPECT_NEAR(many.slip_velocity_at_origin, one.slip_velocity_at_origin, 1e-3 * one.slip_velocity_at_origin);
  EXPECT_NEAR(many.slip_at_origin, one.slip_at_origin, 1e-3 * one.slip_at_origin);
  EXPECT_NEAR(many.energy.dissipated, one.energy.dissipated, 1e-3 * one.energy.dissipated);
}

/// Chains of scale 2000 and 5000 have the slip 0.09630 and 0.09625 and W = 0.01956 and 0.01972 at x = 0.
TEST(ManyTrains, BecomeOneTrainWhereFrictionHasWornTheirRelativeMotionOff) {
  Problem p = smooth_problem(falling, 6, 400);
  p.friction = friction::viscous(1.5);
  pulse::Run run(p, schedule_to(p, 4));
  ASSERT_TRUE(run.go());
  EXPECT_TRUE(run.warnings().empty());
  EXPECT_EQ(run.crossing_time(), 4 / 1.5);
  const output::Snapshot& s = run.snapshots().back();
  EXPECT_EQ(s.profile.trains.size(), s.profile.k.size());
  EXPECT_NEAR(s.slip_at_origin, 0.09627, 2e-3 * 0.09627);
  EXPECT_NEAR(s.slip_velocity_at_origin, 0.01965, 0.02 * 0.01965);
  EXPECT_LT(run.conservation_error(), 1e-4);
  p.friction = friction::viscous(1.4);  // from t = 2.86 on
  p.cells = 100;
  expect_the_same_bits_after_each_step(p);
}

/// Before dislocations overtake each other, the solver of one train has the same cells. Free edges and gaps included.
TEST(ManyTrains, HandOverTheCellsOfOneTrain) {
  const auto gap = [](double x) { return std::fabs(x) < 1 ? 0 : 0.8; };
  const auto free_edge = [](double x) { return x < 0 ? 0.855 : 0; };
  for (const auto& stress : {std::function<double(double)>(gap), std::function<double(double)>(free_edge),
                             std::function<double(double)>(falling)}) {
    Problem p = smooth_problem(stress, 4, 400);
    p.corner = stress(-0.5) == 0.855 ? 0 : HUGE_VAL;
    ManyTrains trains(p);
    pulse::Solver one(p);
    const double end = 0.5;
    const pulse::Cells at_start = one.cells();
    trains.advance_to(end, [] { return false; });
    one.advance_to(end);
    const pulse::Cells made = pulse::cells_of(trains, at_start), &expected = one.cells();
    ASSERT_EQ(made.size(), expected.size());
    double most = 0;
    for (std::size_t i = 0; i < made.size(); ++i) most = std::fmax(most, std::fabs(expected.momentum(i)));
    for (std::size_t i = 0; i < made.size(); ++i) {
      EXPECT_NEAR(made.left_face(i), expected.left_face(i), 1e-3) << i;
      EXPECT_NEAR(made.momentum(i), expected.momentum(i), 0.03 * most) << i;  // cells smear the foot of a fan
    }
  }
}

/// The fans of the gap open from points, on which friction acts as nowhere else. The slip was once 20 % off.
TEST(ManyTrains, SlowDownInAGapAsOneTrainDoes) {
  Problem p = smooth_problem([](double x) { return std::fabs(x) < 1 ? 0 : 0.8; }, 4, 200);
  p.friction = friction::viscous(2);
  const std::vector<double> many = end_of_run(p, 1.5).profile.slip;
  p.many_trains = false;
  const std::vector<double> one = end_of_run(p, 1.5).profile.slip;
  const double largest = *std::max_element(one.begin(), one.end());
  for (std::size_t i = 0; i < one.size(); ++i) EXPECT_NEAR(many[i], one[i], 0.02 * largest) << i;
}

/// A curve once lost its end where points had been removed, because the last point had got another number.
TEST(ManyTrains, KeepTheirEndsWherePointsAreRemoved) {
  Problem p = smooth_problem(falling, 4, 50);
  p.friction = friction::viscous(0.2);
  ManyTrains trains(p);
  trains.advance_to(0.5, [] { return false; });
  EXPECT_LT(trains.conservation_error(), 1e-4);
  for (const double side : {-1.0, 1.0}) EXPECT_EQ(trains.contour().ends(side).size(), 2);
}

TEST(ManyTrains, AreCheckedBeforeTheyBecomeOne) {
  Problem p = smooth_problem([](double x) { return std::fabs(x) < 1 ? 0 : 0.8; }, 4, 200);
  p.friction = friction::viscous(2);
  p.explicit_tolerance = 10;
  EXPECT_THROW(end_of_run(p, 2.5), NumericsError);
}

TEST(ManyTrains, BecomeOneTrainWhereFrictionActsOnThree) {
  Problem p = smooth_problem([](double x) { return 1.1 - 0.6 * std::exp(-x * x / 0.16); }, 4, 200);
  p.friction = friction::viscous(0.05);
  pulse::Run run(p, schedule_to(p, 3));
  ASSERT_TRUE(run.go());
  ASSERT_FALSE(run.warnings().empty());
  EXPECT_NE(run.warnings().back().find("three trains are at x = "), std::string::npos);
  p.many_trains = false;
  const std::vector<double>&many = run.snapshots().back().profile.slip, one = end_of_run(p, 3).profile.slip;
  const double largest = *std::max_element(one.begin(), one.end());
  for (std::size_t i = 0; i < one.size(); ++i) EXPECT_NEAR(many[i], one[i], 0.03 * largest) << i;
}

}  // namespace
