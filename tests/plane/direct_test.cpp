#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>

#include "lattice/plane/direct/motion.hpp"
#include "lattice/plane/direct/sites.hpp"
#include "rings.hpp"
#include "slipfront/error.hpp"
#include "slipfront/lattice/plane/solvers.hpp"
#include "system/archive.hpp"

namespace slipfront::plane {
namespace {

using rings::polar;
using std::numbers::pi;

/// A quarter of a single ring around the corner of a square, at rest at first, without a scale. Free edges mirror it.
class SingleRing {
 public:
  SingleRing(double radius, double spacing) : problem_(square(radius + 10)), sites_(make_sites(problem_, 1, spacing)) {
    std::vector<double> u(sites_.size(), 0.0);
    for (std::size_t j = 0; j < sites_.ny; ++j)
      for (std::size_t i = 0; i < sites_.nx; ++i)
        u[sites_.at(i, j)] = 4 * std::atan(std::exp(radius - std::hypot(sites_.x(i), sites_.y(j))));
    motion_ = stepper_.start(std::move(u));
    stepper_.look_at(motion_, 0, look_);
  }
  const Sums& at(double time) {
    stepper_.advance(motion_, time, {});
    stepper_.look_at(motion_, time, look_);
    return look_;
  }
  /// Distance at which u passes pi along x.
  double radius() const {
    const std::size_t j = 0;
    for (std::size_t i = 0; i < sites_.nx; ++i) {
      const double here = look_.u[sites_.at(i, j)], next = look_.u[sites_.at(i + 1, j)];
      if (!(here >= pi && next < pi)) continue;
      const double x = sites_.x(i) + (here - pi) / (here - next) * sites_.hx;
      return std::hypot(x, sites_.y(j));
    }
    return 0;
  }

 private:
  static Problem square(double side) {
    Problem p;
    p.left = p.bottom = 0;
    p.right = p.top = side;
    return p;
  }
  Problem problem_;
  Sites sites_;
  Stepper stepper_{problem_, sites_, 2};
  Motion motion_;
  Sums look_;
};

// r cosh(phi) is constant, so that r = R cos(t / R).
TEST(PlaneDirect, ASingleRingShrinksAsAStringDoes) {
  constexpr double R = 40;
  SingleRing ring(R, 0.1);
  const double energy = ring.at(0).elastic;
  EXPECT_NEAR(energy / (8 * 2 * pi * R / 4), 1, 2e-3);
  for (const double radius : {35.0, 30.0, 25.0, 20.0}) {
    const Sums& look = ring.at(R * std::acos(radius / R));
    EXPECT_NEAR(ring.radius() / radius, 1, 1e-3) << radius;
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
  p.friction = friction::viscous(1).with("coefficient", {rings::friction_on_one_side, 0, 2});
  const auto solver = plane::direct_solver(p, {.scale = 40, .spacing = 0.25, .threads = 2});
  solver->advance_to(1, {});
  const std::vector<double> slips = solver->slip({polar(1.6, 90), polar(1.6, 0), polar(1.6, -90), polar(2, -90)});
  const double references[] = {0.17259, 0.23368, 0.30096, 0.49563};
  for (std::size_t i = 0; i < slips.size(); ++i) EXPECT_NEAR(slips[i] / references[i], 1, 0.015) << i;
  EXPECT_NEAR(solver->potency() / 3.1128, 1, 0.01);
}

// The plane has 26 lines, and a part of a line at the held region that the averages do not know.
TEST(PlaneDirect, AgreesWithTheAverages) {
  const rings::Slip slip;
  Problem p = rings::problem(slip);
  p.left = p.bottom = -2.6;
  p.right = p.top = 2.6;
  p.friction = friction::viscous(1).with("coefficient",
                                         {[](double x, double) { return 0.5 + 0.3 * std::tanh(x / 0.2); }, 0.2, 0.8});
  p.contact = [](double x, double y) { return 1 + 0.15 * std::exp(-((x - 1.7) * (x - 1.7) + y * y) / 0.1); };
  const auto averaged = plane::loops_solver(p, {.loops = 60, .angles = 64});
  const auto direct = plane::direct_solver(p, {.scale = 60, .threads = 2});
  averaged->advance_to(0.6, {});
  direct->advance_to(0.6, {});
  EXPECT_NEAR(direct->potency() / averaged->potency(), 1, 0.05);
  EXPECT_NEAR(direct->front(1) / averaged->front(1), 1, 0.04);
  const std::vector<Point> points = {polar(1.6, 0), polar(1.7, 90), polar(1.7, 180), polar(1.9, 45)};
  const std::vector<double> a = averaged->slip(points), d = direct->slip(points);
  for (std::size_t i = 0; i < points.size(); ++i) EXPECT_NEAR(d[i], a[i], 0.02) << i;
}

/// A quick problem with friction, contact and a force.
Problem mixed() {
  Problem p;
  p.left = p.bottom = -1.5;
  p.right = p.top = 1.5;
  p.slip = [](double x, double y) { return 2 * std::exp(-(x * x + y * y) / 0.3); };
  p.friction = friction::viscous(1).with("coefficient", {[](double x, double) { return 1 + x / 3; }, 0.5, 1.5});
  p.contact = [](double, double y) { return 1.1 + y / 30; };
  p.forcing = [](double x, double y, double t) { return 0.1 * std::cos(x + t) * std::exp(-y * y); };
  return p;
}

/// The error of the balance of energy at t = 0.5, over the dissipated energy.
double imbalance(const Problem& p, double spacing) {
  const auto solver = plane::direct_solver(p, {.scale = 20, .spacing = spacing, .threads = 2});
  solver->advance_to(0.5, {});
  const Energies e = solver->energies();
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
  p.friction = {};
  p.forcing = {};
  p.friction = friction::coulomb(0.2);
  EXPECT_LT(imbalance(p, 0.2), 0.02);
  const auto solver = plane::direct_solver(p, {.scale = 20});
  solver->advance_to(0.5, {});
  EXPECT_EQ(solver->slip({{1.45, 1.45}})[0], 0);
}

TEST(PlaneDirect, ResumesToTheSameBitsWithAnyThreads) {
  const auto whole = plane::direct_solver(mixed(), {.scale = 20, .threads = 1});
  for (const double time : {0.2, 0.4}) whole->advance_to(time, {});
  const auto first = plane::direct_solver(mixed(), {.scale = 20, .threads = 2});
  first->advance_to(0.2, {});
  int steps = 0;
  EXPECT_FALSE(first->advance_to(0.4, [&] { return ++steps == 3; }));
  const auto second = plane::direct_solver(mixed(), {.scale = 20, .threads = 3});
  restore(*second, saved(*first));
  EXPECT_EQ(second->steps(), first->steps());
  second->advance_to(0.4, {});
  EXPECT_EQ(saved(*second), saved(*whole));
  EXPECT_EQ(second->potency(), whole->potency());
  EXPECT_EQ(second->energies().kinetic, whole->energies().kinetic);
}

TEST(PlaneDirect, AMirroredProblemHasMirroredResults) {
  Problem mirrored = mixed();
  const Problem given = mixed();
  mirrored.friction = given.friction.with("coefficient", {[](double x, double) { return 1 - x / 3; }, 0.5, 1.5});
  mirrored.forcing = [f = given.forcing](double x, double y, double t) { return f(-x, y, t); };
  const auto a = plane::direct_solver(given, {.scale = 20});
  const auto b = plane::direct_solver(mirrored, {.scale = 20});
  a->advance_to(0.3, {});
  b->advance_to(0.3, {});
  EXPECT_NEAR(a->slip({{0.4, 0.2}})[0], b->slip({{-0.4, 0.2}})[0], 1e-9);
  EXPECT_NEAR(a->potency(), b->potency(), 1e-9);
}

/// A law whose positions stick.
friction::Friction slip_weakening(double strength, double residual, double distance) {
  for (const friction::Definition* law : friction::laws())
    if (law->name == "slip-weakening") return friction::Friction(*law, {strength, residual, distance});
  throw std::logic_error("no slip-weakening");
}

/// A bump of slip without friction and forces.
Problem bump() {
  Problem p = mixed();
  p.friction = {};
  p.forcing = {};
  return p;
}

TEST(PlaneDirect, AStaticLoadHoldsTheStartExactly) {
  Problem p = bump();
  p.hold = true;
  const auto held = plane::direct_solver(p, {.scale = 20});
  held->advance_to(1, {});
  EXPECT_NEAR(held->potency_rate(), 0, 1e-90);
  EXPECT_NEAR(held->potency(), 0, 1e-13);
  p.nucleation = Nucleation{.x = 0.5, .y = 0, .radius = 0.3, .time = 0.5};
  const auto released = plane::direct_solver(p, {.scale = 20});
  released->advance_to(0.5, {});
  EXPECT_NEAR(released->potency(), 0, 1e-13);
  released->advance_to(0.8, {});
  EXPECT_GT(std::fabs(released->potency()), 1e-3);
  EXPECT_NEAR(released->slip({{-1.3, 0}})[0], 0, 1e-9);  // 1.5 away from the patch, 0.3 later
  const Energies e = released->energies();
  EXPECT_NEAR(e.kinetic + e.elastic, e.supplied, 0.02 * e.kinetic);
}

TEST(PlaneDirect, StrengthHoldsTheStartUntilNucleation) {
  Problem p = bump();
  const DirectOptions options{.scale = 20};
  const double unbalanced = largest_unbalanced_force(p, options, 30, 30);
  EXPECT_GT(unbalanced, 0.5);
  p.friction = slip_weakening(100 * unbalanced, 0, 0.1);
  const auto held = plane::direct_solver(p, options);
  held->advance_to(0.5, {});
  EXPECT_EQ(held->potency_rate(), 0);
  p.nucleation = Nucleation{.x = 0.3, .y = 0, .radius = 0.2, .time = 0.1};
  const auto released = plane::direct_solver(p, options);
  released->advance_to(0.3, {});
  EXPECT_GT(std::fabs(released->slip({{0.3, 0}})[0]), 1e-3);  // friction acts outside of the patch only
  EXPECT_EQ(released->slip({{-0.3, 0}})[0], 0);
  EXPECT_EQ(released->energies().dissipated, 0);
  p.friction = slip_weakening(2 * unbalanced, 0.05, 0.5);
  p.nucleation = Nucleation{.x = 0.3, .y = 0, .radius = 0.3, .time = 0};
  const auto whole = plane::direct_solver(p, {.scale = 20, .spacing = 0.2});
  const auto first = plane::direct_solver(p, {.scale = 20, .spacing = 0.2});
  const auto second = plane::direct_solver(p, {.scale = 20, .spacing = 0.2, .threads = 2});
  whole->advance_to(0.7, {});
  int steps = 0;
  EXPECT_FALSE(first->advance_to(0.7, [&] { return ++steps == 40; }));
  restore(*second, saved(*first));
  second->advance_to(0.7, {});
  EXPECT_EQ(saved(*second), saved(*whole));
  const Energies e = whole->energies();
  EXPECT_GT(e.dissipated, 0);
  EXPECT_NEAR(e.kinetic + e.elastic + e.dissipated, 0, 0.05 * (e.kinetic + e.dissipated));
}

/// Waves that a force makes in the middle leave through absorbing edges. Contacts are few, so that waves are linear.
double left_behind(Edges edges, double spacing) {
  Problem p;
  p.left = p.bottom = -4;
  p.right = p.top = 4;
  p.slip = [](double, double) { return 0; };
  p.contact = [](double, double) { return 0.01; };
  p.forcing = [](double x, double y, double t) { return 5 * std::exp(-2 * (x * x + y * y) - 4 * (t - 2) * (t - 2)); };
  p.edges = edges;
  const auto solver = plane::direct_solver(p, {.scale = 1, .spacing = spacing});
  solver->advance_to(14, {});
  const Energies e = solver->energies();
  EXPECT_NEAR((e.kinetic + e.elastic + e.radiated) / e.supplied, 1, 0.02) << spacing;
  return (e.kinetic + e.elastic) / e.supplied;
}

TEST(PlaneDirect, WavesLeaveThroughAbsorbingEdges) {
  EXPECT_LT(left_behind(Edges::absorbing, 0.002), 0.01);
  EXPECT_LT(left_behind(Edges::absorbing, 0.001), 0.003);
  EXPECT_GT(left_behind(Edges::free, 0.002), 0.9);
}

/// The largest velocity of a plane wave that comes back from edges at a right angle, over that of the wave. Edges with
/// the impedance Z would send back (1 - Z) / (1 + Z) of it. The edges at the ends of its crest are too distant to be
/// noticed. What comes back is of first order in the spacing, 0.030 here and 0.061 at twice the spacing.
double reflected(bool along_y) {
  Problem p;
  const double wide = 2.5, long_ = 9;
  p.left = -(along_y ? long_ : wide), p.right = -p.left;
  p.bottom = -(along_y ? wide : long_), p.top = -p.bottom;
  p.slip = [](double, double) { return 0; };
  p.contact = [](double, double) { return 0.01; };
  p.forcing = [=](double x, double y, double t) {
    const double across = along_y ? y : x;
    return std::exp(-4 * across * across - 4 * (t - 1.5) * (t - 1.5));
  };
  p.edges = Edges::absorbing;
  const auto solver = plane::direct_solver(p, {.scale = 1, .spacing = 0.0005});
  double sent = 0, returned = 0;
  for (const double time : {2.0, 2.5, 3.0, 5.6, 6.0, 6.4, 6.8}) {
    solver->advance_to(time, {});
    const plane::Field field = along_y ? solver->field(7, 20) : solver->field(20, 7);
    for (int i = 0; i < 20; ++i) {
      double& most = time < 4 ? sent : returned;
      most = std::fmax(most, std::fabs(field.velocity[static_cast<std::size_t>(along_y ? 7 * i + 3 : 60 + i)]));
    }
  }
  return returned / sent;
}

TEST(PlaneDirect, EdgesHaveTheImpedanceOfTheWave) {
  for (const bool along_y : {false, true}) EXPECT_LT(reflected(along_y), 0.035);
}

/// Between two steps, slip and velocity are those of a constant acceleration.
TEST(PlaneDirect, ResultsAreSmoothBetweenSteps) {
  const auto solver = plane::direct_solver(mixed(), {.scale = 20});
  const std::vector<Point> points{{0.2, 0.1}, {-0.4, 0.3}};
  std::vector<double> slip[3], velocity[3];
  constexpr double apart = 2e-4;  // a step is 2e-2
  for (int i = 0; i < 3; ++i) {
    solver->advance_to(0.5 + apart * (i - 1), {});
    slip[i] = solver->slip(points);
    velocity[i] = solver->velocity(points);
  }
  for (std::size_t k = 0; k < points.size(); ++k) {
    EXPECT_NEAR((slip[2][k] - slip[0][k]) / (2 * apart) / velocity[1][k], 1, 1e-4);
    EXPECT_NEAR((slip[2][k] - 2 * slip[1][k] + slip[0][k]) / apart / (velocity[2][k] - velocity[1][k]), 1, 1e-3);
  }
}

TEST(PlaneDirect, FixedEdgesDoNotSlip) {
  Problem p = mixed();
  p.slip = [](double x, double) { return 1.5 + x; };
  p.edges = Edges::fixed;
  const auto solver = plane::direct_solver(p, {.scale = 20});
  solver->advance_to(0.5, {});
  const Field field = solver->field(60, 60);
  EXPECT_GT(std::fabs(field.slip[30 * 60 + 30]), 1e-3);
  EXPECT_EQ(solver->velocity({{0, 0}}).size(), 1u);
}

std::string message_of(const Problem& problem, const DirectOptions& options) {
  try {
    plane::direct_solver(problem, options);
  } catch (const InputError& error) {
    return error.what();
  }
  return {};
}

TEST(PlaneDirect, Refuses) {
  EXPECT_NE(message_of(mixed(), {.scale = 20, .spacing = 0.6}).find("spacing"), std::string::npos);
  EXPECT_NE(message_of(mixed(), {.scale = 1e7}).find("ten billion sites"), std::string::npos);
  Problem steep = mixed();
  steep.slip = [](double x, double y) { return 9 * std::exp(-(x * x + y * y) / 0.3); };
  EXPECT_NE(message_of(steep, {.scale = 20}).find("lines are as close as"), std::string::npos);
}

}  // namespace
}  // namespace slipfront::plane
