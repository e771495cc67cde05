#include "slipfront/theory/rupture/riemann_trains.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "slipfront/error.hpp"
#include "slipfront/theory/rupture/relations.hpp"
#include "slipfront/theory/train.hpp"

namespace {

using namespace slipfront;
using rupture::Region;
using rupture::TrainsPoint;
using rupture::TrainsSolution;
using rupture::Wave;

/// PHYSICS.md, section 14: steps of stress at rest. W(0) of the first was printed without one of its digits 3, as
/// 0.0442333371; mpmath gives 0.04423333371 too.
TEST(RiemannTrains, ReproduceThePrintedSteps) {
  const struct {
    double left, right, fan, k, W, from, to, r, k0, W0, digits;
  } rows[] = {{0.855, 0.179, -0.1706343, 0.7192459, 0.0361498, -0.1706335, 0.1207373, 0.0650742284, 0.6156052697,
               0.0442333337, 5e-11},
              {1.03, 0.4, -0.2623810, 0.8411222, 0.0769591, -0.2508426, 0.2607497, 0.0991501755, 0.7843248691,
               0.0828168462, 5e-11},
              {0.606, 0.3, -0.0549959, 0.5349833, 0.0059627, -0.0536658, 0.0392187, 0.0139078691, 0.5011686279,
               0.0066995398, 5e-11}};
  for (const auto& row : rows) {
    const TrainsSolution s = rupture::solve_trains(train::at_rest(row.left), train::at_rest(row.right));
    ASSERT_EQ(s.regions.size(), 3U);
    EXPECT_EQ(s.regions[0].kind, Region::Kind::fan);
    EXPECT_EQ(s.regions[1].kind, Region::Kind::constant);
    EXPECT_EQ(s.regions[2].kind, Region::Kind::two_trains);
    EXPECT_NEAR(s.regions[0].to, row.fan, 6e-8);
    EXPECT_NEAR(s.regions[2].from, row.from, 6e-8);
    EXPECT_NEAR(s.regions[2].to, row.to, 6e-8);
    const TrainsPoint star = rupture::profile_point(s.star), origin = rupture::profile_point(s, 0);
    EXPECT_NEAR(star.all.Sigma, row.k, 6e-8);
    EXPECT_NEAR(star.all.W, row.W, 6e-8);
    ASSERT_EQ(origin.trains.size(), 2U);
    EXPECT_NEAR(origin.trains[1].lowest, row.r, row.digits);
    EXPECT_NEAR(origin.all.Sigma, row.k0, row.digits);
    EXPECT_NEAR(origin.all.W, row.W0, row.digits);
    EXPECT_EQ(origin.slip, origin.all.W);
  }
}

/// PHYSICS.md, section 14: trains that pass through each other.
TEST(RiemannTrains, ReproduceThePrintedCollision) {
  const TrainsSolution s =
      rupture::solve_trains(rupture::moving_train(1, 0.3, "left"), rupture::moving_train(0.5, -0.2, "right"));
  ASSERT_EQ(s.regions.size(), 3U);
  EXPECT_EQ(s.regions[1].trains, 2U);
  EXPECT_NEAR(s.regions[0].from, -0.5516, 6e-5);
  EXPECT_NEAR(s.regions[0].to, -0.5168543, 6e-8);
  EXPECT_NEAR(s.regions[1].to, -0.0689257, 6e-8);
  EXPECT_NEAR(s.regions[2].to, 0.5504, 6e-5);
  const TrainsPoint star = rupture::profile_point(s.star), origin = rupture::profile_point(s, 0);
  EXPECT_NEAR(star.all.Sigma, 1.1814239, 6e-8);
  EXPECT_NEAR(star.all.W, 0.2007962, 6e-8);
  EXPECT_NEAR(origin.trains[1].lowest, 0.197790184, 6e-10);
  EXPECT_NEAR(origin.all.Sigma, 1.163300692, 6e-10);
  EXPECT_NEAR(origin.all.W, 0.201413471, 6e-10);
}

/// PHYSICS.md, section 14: W and k of the first step over x/t, with four digits.
TEST(RiemannTrains, ReproduceThePrintedProfile) {
  const TrainsSolution s = rupture::solve_trains(train::at_rest(0.855), train::at_rest(0.179));
  const double rows[][3] = {{-0.1208, 0.03979, 0.6941}, {-0.0688, 0.04264, 0.6639}, {-0.0136, 0.04416, 0.6262},
                            {0.0158, 0.04413, 0.6024},  {0.0467, 0.04318, 0.5727},  {0.0802, 0.04043, 0.5299}};
  for (const auto& [x, W, k] : rows) {
    const TrainsPoint point = rupture::profile_point(s, x);
    EXPECT_NEAR(point.all.W, W, 1.1e-5);  // x/t is printed with four digits
    EXPECT_NEAR(point.all.Sigma, k, 6e-5);
  }
}

/// Trains of random width whose four edges have one of the six orders.
std::array<State, 2> random_trains(std::mt19937_64& draw, int order) {
  std::uniform_real_distribution<double> log_width(std::log(1e-3), std::log(1.0));
  std::array<double, 4> edges{};
  edges[0] = std::uniform_real_distribution(-1.0, 0.0)(draw);
  for (std::size_t i = 1; i < 4; ++i) edges[i] = edges[i - 1] + std::exp(log_width(draw));
  constexpr std::size_t left[6][2] = {{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}};
  std::array<double, 2> of_left{}, of_right{};
  std::size_t lefts = 0, rights = 0;
  for (std::size_t i = 0; i < 4; ++i)
    (i == left[order][0] || i == left[order][1] ? of_left[lefts++] : of_right[rights++]) = edges[i];
  const auto state = [](const std::array<double, 2>& e) { return State{(e[0] + e[1]) / 2, (e[1] - e[0]) / 2}; };
  return {state(of_left), state(of_right)};
}

TEST(RiemannTrains, AreTheSameInEveryFrame) {
  std::mt19937_64 draw(300);
  for (int n = 0; n < 300; ++n) {
    auto [left, right] = random_trains(draw, n % 6);
    const TrainsSolution a = rupture::solve_trains(left, right);
    const double boost = std::uniform_real_distribution(-1.0, 1.0)(draw);
    left.phi += boost;
    right.phi += boost;
    const TrainsSolution b = rupture::solve_trains(left, right);
    const double c = std::cosh(boost), s = std::sinh(boost);
    const auto boosted = [&](double v) { return (v * c + s) / (c + v * s); };
    ASSERT_EQ(a.regions.size(), b.regions.size()) << n;
    for (std::size_t i = 0; i < a.regions.size(); ++i) {
      const Region &one = a.regions[i], &two = b.regions[i];
      ASSERT_EQ(one.kind, two.kind) << n;
      ASSERT_NEAR(two.from, boosted(one.from), 1e-12) << n;
      ASSERT_NEAR(two.to, boosted(one.to), 1e-12) << n;
      for (const double share : {0.1, 0.5, 0.9}) {
        const double x = one.from + share * (one.to - one.from);
        const TrainsPoint p = rupture::profile_point(a, x), q = rupture::profile_point(b, boosted(x));
        ASSERT_EQ(p.trains.size(), one.trains) << n;
        ASSERT_EQ(q.trains.size(), one.trains) << n;
        ASSERT_NEAR(q.all.Sigma, c * p.all.Sigma + s * p.all.W, 1e-10 * q.all.Sigma) << n;
        ASSERT_NEAR(q.all.W, c * p.all.W + s * p.all.Sigma, 1e-10 * q.all.Sigma) << n;
      }
    }
  }
}

/// Regions follow one another, nothing jumps between them, and -g' = Sigma - Sigma_0 for the slip t g(x/t).
TEST(RiemannTrains, AreContinuousAndConserveDislocations) {
  std::mt19937_64 draw(301);
  for (int n = 0; n < 120; ++n) {
    const auto [left, right] = random_trains(draw, n % 6);
    const TrainsSolution s = rupture::solve_trains(left, right);
    const auto [first, last] = rupture::edges_of(s);
    ASSERT_EQ(s.regions.front().from, first) << n;
    ASSERT_EQ(s.regions.back().to, last) << n;
    for (std::size_t i = 1; i < s.regions.size(); ++i) ASSERT_EQ(s.regions[i].from, s.regions[i - 1].to) << n;
    // At an edge where a band opens, k rises from it like 1 / ln, so we test slip, which has no such edge.
    for (const Region& region : s.regions)
      for (const double edge : {region.from, region.to}) {
        const double small = 1e-7;
        ASSERT_NEAR(rupture::profile_point(s, edge - small).slip, rupture::profile_point(s, edge + small).slip, 1e-5)
            << n;
      }
    for (const Region& region : s.regions) {
      const double x = region.from + 0.37 * (region.to - region.from), h = 0.02 * (region.to - region.from);
      if (x * (x + 2 * h) < 0 || x * (x - 2 * h) < 0) continue;  // Sigma_0 jumps at x = 0
      const auto slip = [&](double at) { return rupture::profile_point(s, at).slip; };
      const double slope = (8 * (slip(x + h) - slip(x - h)) - slip(x + 2 * h) + slip(x - 2 * h)) / (12 * h);
      const double initial = train::averages(x < 0 ? left : right).k;
      const double k = rupture::profile_point(s, x).all.Sigma;
      ASSERT_NEAR(-slope, k - initial, 1e-5 * (k + initial)) << n << " " << rupture::name_of(region.kind);
    }
  }
}

TEST(RiemannTrains, HaveTheMirrorImageOfMirroredTrains) {
  std::mt19937_64 draw(302);
  for (int n = 0; n < 60; ++n) {
    const auto [left, right] = random_trains(draw, n % 6);
    const TrainsSolution a = rupture::solve_trains(left, right),
                         b = rupture::solve_trains({-right.phi, right.psi}, {-left.phi, left.psi});
    ASSERT_EQ(a.regions.size(), b.regions.size());
    for (std::size_t i = 0; i < a.regions.size(); ++i) {
      const Region &one = a.regions[i], &two = b.regions[a.regions.size() - 1 - i];
      ASSERT_EQ(one.kind, two.kind);
      ASSERT_NEAR(one.from, -two.to, 1e-12);
      ASSERT_NEAR(one.to, -two.from, 1e-12);
      const double x = one.from + 0.3 * (one.to - one.from);
      const TrainsPoint p = rupture::profile_point(a, x), q = rupture::profile_point(b, -x);
      ASSERT_NEAR(p.all.Sigma, q.all.Sigma, 1e-10);
      ASSERT_NEAR(p.slip, -q.slip, 1e-10);
    }
  }
}

TEST(RiemannTrains, AreTheSlipPulseIfOneSideIsEmpty) {
  const rupture::RiemannSolution pulse = rupture::slip_pulse(1.03);
  const TrainsSolution s = rupture::solve_trains(train::at_rest(1.03), {});
  ASSERT_EQ(s.regions.size(), 1U);
  EXPECT_EQ(s.regions[0].from, pulse.left_wave.outer);
  EXPECT_NEAR(s.regions[0].to, pulse.left_wave.inner, 1e-15);
  for (const double x : {-0.6, -0.3, 0.0, 0.1, 0.5}) {
    const rupture::ProfilePoint one = rupture::profile_point(pulse, x);
    const TrainsPoint two = rupture::profile_point(s, x);
    EXPECT_NEAR(two.all.Sigma, one.Sigma, 1e-13);
    EXPECT_NEAR(two.all.W, one.W, 1e-13);
    EXPECT_NEAR(two.all.P, one.P, 1e-13);
  }
  const TrainsSolution mirror = rupture::solve_trains({}, train::at_rest(1.03));
  EXPECT_EQ(mirror.regions[0].from, -s.regions[0].to);
}

TEST(RiemannTrains, MirroredTrainsThatMeetHaveNoMeanMotion) {
  for (const double phi : {0.1, 0.31, 0.7}) {
    const TrainsPoint p = rupture::profile_point(rupture::solve_trains({phi, 0.5}, {-phi, 0.5}), 0);
    EXPECT_EQ(p.all.W, 0);
    EXPECT_EQ(p.all.U, 0);
    EXPECT_EQ(p.all.P, 0);
  }
}

TEST(RiemannTrains, LeaveAVacuumBetweenTrainsThatPart) {
  const TrainsSolution s = rupture::solve_trains({-1, 0.3}, {1, 0.2});
  ASSERT_EQ(s.regions.size(), 3U);
  EXPECT_EQ(s.regions[1].kind, Region::Kind::vacuum);
  EXPECT_NEAR(s.regions[1].from, std::tanh(-0.7), 1e-15);
  EXPECT_NEAR(s.regions[1].to, std::tanh(0.8), 1e-15);
  EXPECT_EQ(rupture::profile_point(s, 0).all.Sigma, 0);
  EXPECT_TRUE(rupture::profile_point(s, 0).trains.empty());
}

TEST(RiemannTrains, AreOneConstantStateForEqualTrains) {
  const TrainsSolution s = rupture::solve_trains({0.2, 0.3}, {0.2, 0.3});
  ASSERT_EQ(s.regions.size(), 1U);
  EXPECT_EQ(s.regions[0].kind, Region::Kind::constant);
  EXPECT_NEAR(rupture::profile_point(s, 0.1).all.Sigma, train::averages({0.2, 0.3}).k, 1e-13);
}

TEST(RiemannTrains, TendToTheClosedFormAsTheRightStressVanishes) {
  const rupture::Relations closed = rupture::from_stress(0.855);
  const rupture::StepRelations zero = rupture::step_relations(0.855, 0);
  EXPECT_NEAR(zero.slip_velocity, closed.slip_velocity, 1e-14);
  EXPECT_NEAR(zero.stress_at_origin, closed.stress_at_origin, 1e-14);
  EXPECT_NEAR(zero.leading_velocity, closed.leading_velocity, 1e-15);
  EXPECT_EQ(zero.trains_at_origin, 1);
  // Here psi on the right is 1e-296, so that neighbouring widths have a product below the smallest double.
  const rupture::StepRelations tiny = rupture::step_relations(0.855, 0.0046);
  EXPECT_NEAR(tiny.slip_velocity, closed.slip_velocity, 5e-4);
  EXPECT_NEAR(tiny.leading_velocity, closed.leading_velocity, 5e-4);
  double before = closed.leading_velocity, error = 1;
  for (const double right : {0.005, 0.01, 0.05, 0.1, 0.2, 0.4, 0.8}) {
    const rupture::StepRelations r = rupture::step_relations(0.855, right);
    EXPECT_EQ(r.rupture_velocity, closed.rupture_velocity);
    EXPECT_GT(r.leading_velocity, before);  // V+ rises with the stress ahead
    EXPECT_LT(r.slip_velocity, closed.slip_velocity);
    before = r.leading_velocity;
    if (right <= 0.01) {
      EXPECT_LT(std::fabs(r.slip_velocity - closed.slip_velocity), error);
    }
    error = 1e-3;
  }
  const rupture::StepRelations small_drop = rupture::step_relations(0.855, 0.855 * (1 - 1e-7));
  EXPECT_NEAR(small_drop.velocity_ratio, 1, 1e-6);  // V- and V+ are equal as the drop vanishes
}

TEST(RiemannTrains, RefuseStatesOutsideTheRange) {
  EXPECT_THROW(rupture::solve_trains({0, 21}, {0, 1}), InputError);
  EXPECT_THROW(rupture::solve_trains({0, 1}, {19, 1}), InputError);
  EXPECT_THROW(rupture::solve_trains({0, -1}, {0, 1}), InputError);
  EXPECT_THROW(rupture::solve_trains({0, NAN}, {0, 1}), InputError);
  EXPECT_THROW(rupture::step_relations(0.5, 0.6), InputError);
  EXPECT_THROW(rupture::step_relations(0.5, 1e-5), InputError);
  EXPECT_NO_THROW(rupture::solve_trains({-18, 15}, {18, 15}));
  EXPECT_NO_THROW(rupture::profile_point(rupture::solve_trains({18, 15}, {-18, 15}), 0));
}

}  // namespace
