#include "slipfront/plane/direct.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>

#include "plane/direct/motion.hpp"
#include "plane/direct/sites.hpp"
#include "rings.hpp"
#include "slipfront/error.hpp"
#include "slipfront/plane/averaged.hpp"

namespace slipfront::plane {
namespace {

using std::numbers::pi;

Point at(double r, double degrees) { return {r * std::cos(degrees * pi / 180), r * std::sin(degrees * pi / 180)}; }

/// A single ring around the origin of a square, at rest at first, without a scale.
class SingleRing {
 public:
  SingleRing(double radius, double spacing) : problem_(square()), sites_(make_sites(problem_, 1, spacing)) {
    std::vector<double> u(sites_.size(), 0.0);
    for (std::size_t j = 0; j < sites_.ny; ++j)
      for (std::size_t i = 0; i < sites_.nx; ++i)
        u[sites_.at(i, j)] = 4 * std::atan(std::exp(radius - std::hypot(sites_.x(i), sites_.y(j))));
    motion_ = stepper_.start(std::move(u));
    stepper_.look_at(motion_, 0, look_);
  }
  const Look& at(double time) {
    stepper_.advance(motion_, time, {});
    stepper_.look_at(motion_, time, look_);
    return look_;
  }
  /// Distance at which u passes pi along x.
  double radius() const {
    const std::size_t j = sites_.ny / 2;
    for (std::size_t i = sites_.nx / 2; i < sites_.nx; ++i) {
      const double here = look_.u[sites_.at(i, j)], next = look_.u[sites_.at(i + 1, j)];
      if (!(here >= pi && next < pi)) continue;
      const double x = sites_.x(i) + (here - pi) / (here - next) * sites_.hx;
      return std::hypot(x, sites_.y(j));
    }
    return 0;
  }

 private:
  static Problem square() {
    Problem p;
    p.left = p.bottom = -50;
    p.right = p.top = 50;
    return p;
  }
  Problem problem_;
  Sites sites_;
  Stepper stepper_{problem_, sites_, 2};
  Motion motion_;
  Look look_;
};

// r cosh(phi) is constant, so that r = R cos(t / R).
TEST(PlaneDirect, ASingleRingShrinksAsAStringDoes) {
  constexpr double R = 40;
  SingleRing ring(R, 0.2);
  const double energy = ring.at(0).elastic;
  EXPECT_NEAR(energy / (8 * 2 * pi * R), 1, 2e-3);
  for (const double radius : {35.0, 30.0, 25.0, 20.0}) {
    const Look& look = ring.at(R * std::acos(radius / R));
    EXPECT_NEAR(ring.radius() / radius, 1, 2.5e-3) << radius;
    EXPECT_NEAR((look.kinetic + look.elastic) / energy, 1, 1e-4) << radius;
  }
}

TEST(PlaneDirect, IsOfFourthOrder) {
  double kinetic[3];
  int i = 0;
  for (const double spacing : {0.5, 0.25, 0.125}) kinetic[i++] = SingleRing(30, spacing).at(20).kinetic;
  const double order = std::log2((kinetic[0] - kinetic[1]) / (kinetic[1] - kinetic[2]));
  EXPECT_NEAR(order, 4, 0.6) << kinetic[0] << ' ' << kinetic[1] << ' ' << kinetic[2];
}

// The reference is another program with another scheme (leapfrog, spacing 0.25) at the same scale.
TEST(PlaneDirect, FrictionOnOneSideAgreesWithAnotherProgram) {
  const rings::Slip slip;
  Problem p = rings::problem(slip);
  p.viscous = rings::friction_on_one_side;
  DirectSolver solver(p, {.scale = 40, .spacing = 0.25, .threads = 2});
  solver.advance_to(1, {});
  const std::vector<double> slips = solver.slip({at(1.6, 90), at(1.6, 0), at(1.6, -90), at(2, -90)});
  const double references[] = {0.17259, 0.23368, 0.30096, 0.49563};
  for (std::size_t i = 0; i < slips.size(); ++i) EXPECT_NEAR(slips[i] / references[i], 1, 0.015) << i;
  EXPECT_NEAR(solver.potency() / 3.1128, 1, 0.01);
}

// The plane has 26 lines, and a part of a line at the held region that the averages do not know.
TEST(PlaneDirect, AgreesWithTheAverages) {
  const rings::Slip slip;
  Problem p = rings::problem(slip);
  p.left = p.bottom = -2.6;
  p.right = p.top = 2.6;
  p.viscous = [](double x, double) { return 0.5 + 0.3 * std::tanh(x / 0.2); };
  p.contact = [](double x, double y) { return 1 + 0.15 * std::exp(-((x - 1.7) * (x - 1.7) + y * y) / 0.1); };
  AveragedSolver averaged(p, {.loops = 60, .angles = 64});
  DirectSolver direct(p, {.scale = 60, .threads = 2});
  averaged.advance_to(0.6, {});
  direct.advance_to(0.6, {});
  EXPECT_NEAR(direct.potency() / averaged.potency(), 1, 0.05);
  EXPECT_NEAR(direct.front(1) / averaged.front(1), 1, 0.04);
  const std::vector<Point> points = {at(1.6, 0), at(1.7, 90), at(1.7, 180), at(1.9, 45)};
  const std::vector<double> a = averaged.slip(points), d = direct.slip(points);
  for (std::size_t i = 0; i < points.size(); ++i) EXPECT_NEAR(d[i], a[i], 0.02) << i;
}

/// A quick problem with friction, contact and a force.
Problem mixed() {
  Problem p;
  p.left = p.bottom = -1.5;
  p.right = p.top = 1.5;
  p.slip = [](double x, double y) { return 2 * std::exp(-(x * x + y * y) / 0.3); };
  p.viscous = [](double x, double) { return 1 + x / 3; };
  p.contact = [](double, double y) { return 1.1 + y / 30; };
  p.forcing = [](double x, double y, double t) { return 0.1 * std::cos(x + t) * std::exp(-y * y); };
  return p;
}

/// The error of the balance of energy at t = 0.5, over the dissipated energy.
double imbalance(const Problem& p, double spacing) {
  DirectSolver solver(p, {.scale = 20, .spacing = spacing, .threads = 2});
  solver.advance_to(0.5, {});
  const Energies e = solver.energies();
  EXPECT_GT(e.dissipated, 0);
  return std::fabs(e.kinetic + e.elastic + e.dissipated - e.supplied) / e.dissipated;
}

TEST(PlaneDirect, BudgetOfEnergyHolds) {
  const double fine = imbalance(mixed(), 0.2), coarse = imbalance(mixed(), 0.4);
  EXPECT_LT(fine, 0.02);
  EXPECT_LT(fine, coarse / 3);
}

TEST(PlaneDirect, CoulombFrictionHoldsAndRubs) {
  Problem p = mixed();
  p.viscous = {};
  p.forcing = {};
  p.friction = friction::coulomb(0.2);
  EXPECT_LT(imbalance(p, 0.2), 0.02);
  DirectSolver solver(p, {.scale = 20});
  solver.advance_to(0.5, {});
  EXPECT_EQ(solver.slip({{1.45, 1.45}})[0], 0);
}

TEST(PlaneDirect, ResumesToTheSameBitsWithAnyThreads) {
  DirectSolver whole(mixed(), {.scale = 20, .threads = 1});
  for (const double time : {0.2, 0.4}) whole.advance_to(time, {});
  DirectSolver first(mixed(), {.scale = 20, .threads = 2});
  first.advance_to(0.2, {});
  int steps = 0;
  EXPECT_FALSE(first.advance_to(0.4, [&] { return ++steps == 3; }));
  DirectSolver second(mixed(), {.scale = 20, .threads = 3});
  second.resume(first.saved());
  EXPECT_EQ(second.steps(), first.steps());
  second.advance_to(0.4, {});
  EXPECT_EQ(second.saved(), whole.saved());
  EXPECT_EQ(second.potency(), whole.potency());
  EXPECT_EQ(second.energies().kinetic, whole.energies().kinetic);
}

TEST(PlaneDirect, AMirroredProblemHasMirroredResults) {
  Problem mirrored = mixed();
  const Problem given = mixed();
  mirrored.viscous = [f = given.viscous](double x, double y) { return f(-x, y); };
  mirrored.forcing = [f = given.forcing](double x, double y, double t) { return f(-x, y, t); };
  DirectSolver a(given, {.scale = 20}), b(mirrored, {.scale = 20});
  a.advance_to(0.3, {});
  b.advance_to(0.3, {});
  EXPECT_NEAR(a.slip({{0.4, 0.2}})[0], b.slip({{-0.4, 0.2}})[0], 1e-9);
  EXPECT_NEAR(a.potency(), b.potency(), 1e-9);
}

std::string message_of(const Problem& problem, const DirectOptions& options) {
  try {
    DirectSolver(problem, options);
  } catch (const InputError& error) {
    return error.what();
  }
  return {};
}

TEST(PlaneDirect, Refuses) {
  EXPECT_NE(message_of(mixed(), {.scale = 20, .spacing = 0.6}).find("spacing"), std::string::npos);
  EXPECT_NE(message_of(mixed(), {.scale = -1}).find("scale"), std::string::npos);
  EXPECT_NE(message_of(mixed(), {.scale = 1e7}).find("ten billion sites"), std::string::npos);
  Problem steep = mixed();
  steep.slip = [](double x, double y) { return 9 * std::exp(-(x * x + y * y) / 0.3); };
  EXPECT_NE(message_of(steep, {.scale = 20}).find("lines are as close as"), std::string::npos);
  Problem with_state = mixed();
  with_state.viscous = {};
  for (const friction::Definition* law : friction::laws())
    if (law->name == "slip-weakening")
      with_state.friction = friction::Friction(*law, {0.2, 0.1, 1.0}, friction::Closure::consistent);
  EXPECT_NE(message_of(with_state, {.scale = 20}).find("state"), std::string::npos);
}

}  // namespace
}  // namespace slipfront::plane
