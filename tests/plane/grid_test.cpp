#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numbers>
#include <string>
#include <string_view>
#include <vector>

#include "resumed.hpp"
#include "rings.hpp"
#include "slipfront/error.hpp"
#include "slipfront/lattice/plane/solvers.hpp"
#include "system/archive.hpp"

namespace {

using namespace slipfront;
using plane::Point;
using plane::Problem;
using rings::polar;

Problem friction_on_one_side() {
  static const rings::Slip slip;
  Problem problem = rings::problem(slip);
  problem.friction = friction::viscous(1).with("coefficient", {rings::friction_on_one_side, 0, 2});
  return problem;
}

/// The direct run has the scale 160 and averages over boxes.
TEST(PlaneGrid, FrictionOnOneSideAgreesWithEveryLine) {
  const auto solver = plane::grid_solver(friction_on_one_side(), 100);
  EXPECT_TRUE(solver->advance_to(1, {}));
  const std::vector<double> slip =
      solver->slip({polar(1.6, 90), polar(1.6, 0), polar(1.6, -90), polar(2.2, 0), polar(2.2, -90)});
  const std::vector<double> direct = {0.17662, 0.23793, 0.30931, 0.17312, 0.2655};
  for (std::size_t i = 0; i < slip.size(); ++i) EXPECT_NEAR(slip[i] / direct[i], 1, 0.04) << i;
  EXPECT_NEAR(solver->potency() / 3.1787, 1, 0.01);
  EXPECT_NEAR(solver->front(1) / 2.466, 1, 0.01);
  const plane::Energies e = solver->energies();
  EXPECT_NEAR((e.kinetic + e.dissipated) / -e.elastic, 1, 0.06);
}

/// The error of the slip falls at least as the size of the cells.
TEST(PlaneGrid, Converges) {
  const auto slip = [](int cells) {
    const auto solver = plane::grid_solver(friction_on_one_side(), cells);
    solver->advance_to(1, {});
    return solver->slip({polar(1.6, -90)}).front();
  };
  const double exact = 0.3133;  // the averages along loops give this
  const double coarse = std::fabs(slip(50) - exact), middle = std::fabs(slip(100) - exact);
  EXPECT_GT(coarse, 1.8 * middle);
  EXPECT_LT(middle, 0.02 * exact);
}

/// Lines that a force drives around a held region, which no star-shaped solver follows.
Problem barrier() {
  Problem p;
  p.left = p.bottom = -4;
  p.right = p.top = 4;
  p.fixed = [](double x, double y) { return std::hypot(x, y) < 1 || std::hypot(x - 2.2, y) < 0.25 ? 1.0 : 0.0; };
  p.slip = [](double x, double y) { return 4 * std::fmax(0, 2 - std::fmax(1, std::hypot(x, y))); };
  p.friction = friction::viscous(2.0);
  p.forcing = [](double, double, double) { return 3.0; };
  return p;
}

TEST(PlaneGrid, LinesWalkAroundABarrierAsEveryLineDoes) {
  const auto averaged = plane::grid_solver(barrier(), 80);
  const auto direct = plane::direct_solver(barrier(), {.scale = 20});
  averaged->advance_to(2, {});
  direct->advance_to(2, {});
  EXPECT_NEAR(averaged->potency() / direct->potency(), 1, 0.02);
  const plane::Field a = averaged->field(40, 40), d = direct->field(40, 40);
  double difference = 0, sum = 0;
  for (std::size_t i = 0; i < a.slip.size(); ++i) {
    difference += std::fabs(a.slip[i] - d.slip[i]);
    sum += std::fabs(d.slip[i]);
  }
  EXPECT_LT(difference, 0.04 * sum);
  EXPECT_NEAR(averaged->slip({{2.2, 0}}).front(), 0, 1e-12);
  ASSERT_EQ(averaged->warnings().size(), 1U);
  EXPECT_NE(averaged->warnings().front().find("have met"), std::string::npos);
}

Problem bump(double x0, double height) {
  Problem p;
  p.left = p.bottom = -4;
  p.right = p.top = 4;
  p.slip = [=](double x, double y) { return height * std::exp(-3 * ((x - x0) * (x - x0) + y * y)); };
  return p;
}

/// Two sources do not notice each other before their lines meet.
TEST(PlaneGrid, TwoSourcesAreTheSumOfBoth) {
  Problem both = bump(0, 1);
  both.slip = [](double x, double y) { return bump(-2, 1).slip(x, y) + bump(2, 2).slip(x, y); };
  const auto two = plane::grid_solver(both, 80);
  const auto first = plane::grid_solver(bump(-2, 1), 80);
  const auto second = plane::grid_solver(bump(2, 2), 80);
  for (plane::Solver* solver : {two.get(), first.get(), second.get()}) solver->advance_to(0.2, {});
  EXPECT_NE(first->potency(), 0);
  EXPECT_NEAR(two->potency() / (first->potency() + second->potency()), 1, 0.01);
}

/// The innermost lines around a peak meet when it falls. The same slip under a load that holds it has no such lines.
TEST(PlaneGrid, LinesMeetWhereAPeakFalls) {
  for (const bool hold : {false, true}) {
    Problem p = bump(0, 1);
    p.hold = hold;
    const auto solver = plane::grid_solver(p, 61);  // the peak is in the middle of a cell
    solver->advance_to(0.3, {});
    EXPECT_EQ(solver->lines_have_met(), !hold);
  }
}

/// A static load holds everything until nucleation, up to the tail of the slip, and then the slip is that of every
/// line.
TEST(PlaneGrid, ALoadHoldsUntilNucleation) {
  Problem p = bump(0, 3);
  p.slip = [](double x, double y) { return 3 * std::exp(-(x * x / 2 + y * y)); };
  p.hold = true;
  p.nucleation = plane::Nucleation{.x = 1, .y = 0, .radius = 0.5, .time = 1};
  p.friction = friction::viscous(2.0);
  const auto averaged = plane::grid_solver(p, 100);
  averaged->advance_to(1, {});
  for (const double slip : averaged->field(40, 40).slip) EXPECT_NEAR(slip, 0, 2e-4);
  averaged->advance_to(1.5, {});
  p.nucleation->time = 0;
  const auto direct = plane::direct_solver(p, {.scale = 40});
  direct->advance_to(0.5, {});
  const std::vector<Point> points{{1, 0}, {1, 0.4}, {0.7, 0}};
  const std::vector<double> a = averaged->slip(points), d = direct->slip(points);
  for (std::size_t i = 0; i < a.size(); ++i) EXPECT_NEAR(a[i] / d[i], 1, 0.08) << i;
}

/// Friction with strength at rest holds what it can.
TEST(PlaneGrid, StrengthHoldsUntilNucleation) {
  Problem p = bump(0, 0.5);
  p.friction = friction::coulomb(30);
  p.nucleation = plane::Nucleation{.x = 0.5, .y = 0, .radius = 0.3, .time = 0.5};
  const auto solver = plane::grid_solver(p, 80);
  solver->advance_to(0.5, {});
  for (const double slip : solver->field(40, 40).slip) EXPECT_NEAR(slip, 0, 1e-15);
  solver->advance_to(1, {});
  EXPECT_LT(solver->slip({{0.5, 0}}).front(), -1e-3);
  EXPECT_NEAR(solver->slip({{-1, 0}}).front(), 0, 1e-15);
}

/// Strength holds lines around a held disc, and weakens with slip, so that a rupture runs from a patch.
Problem weakening() {
  Problem p;
  p.left = p.bottom = -4;
  p.right = p.top = 4;
  p.fixed = [](double x, double y) { return std::hypot(x, y) < 0.7 ? 1.0 : 0.0; };
  p.slip = [](double x, double y) {
    const double r = std::fmax(0, std::hypot(x, y) - 0.7);
    return 3 * std::exp(-0.7 * r * r);
  };
  for (const friction::Definition* law : friction::laws())
    if (law->name == "slip-weakening") p.friction = friction::Friction(*law, {5, 0, 0.2});
  p.nucleation = plane::Nucleation{.x = 1.5, .y = 0, .radius = 0.7, .time = 0};
  return p;
}

/// Three points of the patch have the slip of all lines at scale 160 (slipfront plane --direct), and a point outside,
/// which the rupture has just reached, nearly that at scale 80.
void expect_slip(const plane::Solver& solver, const std::vector<double>& of_lines) {
  const std::vector<double> slip = solver.slip({{1.5, 0}, {1.5, 0.5}, {1.9, 0}, {1.2, 0.8}});
  for (std::size_t i = 0; i < slip.size(); ++i) EXPECT_NEAR(slip[i] / of_lines[i], 1, i < 3 ? 0.015 : 0.1) << i;
}

/// The lines have the scale 160. Their potency is -0.7194 at scale 80, and that of the grid -0.7030 with 320 cells.
TEST(PlaneGrid, WeakeningStrengthAgreesWithEveryLine) {
  const auto solver = plane::grid_solver(weakening(), 160);
  solver->advance_to(1, {});
  EXPECT_NEAR(solver->potency() / -0.7175, 1, 0.04);
  expect_slip(*solver, {-0.50555, -0.28665, -0.16188, -0.16662});
  EXPECT_GT(solver->energies().dissipated, 0);
}

/// cases/plane-nucleation.toml: rate-and-state friction holds the lines until a patch is released.
Problem ageing() {
  Problem p = weakening();
  for (const friction::Definition* law : friction::laws()) {
    if (law->name != "rate-and-state") continue;
    const std::map<std::string_view, double> given{{"strength", 4.5},
                                                   {"direct_effect", 0.2},
                                                   {"evolution_effect", 0.8},
                                                   {"reference_velocity", 1e-3},
                                                   {"characteristic_slip", 0.05}};
    std::vector<double> values;
    for (const friction::Parameter& parameter : law->parameters)
      values.push_back(given.contains(parameter.name) ? given.at(parameter.name) : parameter.value);
    p.friction = friction::Friction(*law, values);
  }
  return p;
}

/// The lines have the scale 160. Their potency is -0.6038 at scale 80, and that of the grid -0.5952 with 320 cells.
TEST(PlaneGrid, RateAndStateFrictionAgreesWithEveryLine) {
  const auto solver = plane::grid_solver(ageing(), 80);
  solver->advance_to(1, {});
  EXPECT_NEAR(solver->potency() / -0.6027, 1, 0.02);
  expect_slip(*solver, {-0.50482, -0.27163, -0.16165, -0.08480});
}

/// A steep power of the slip velocity holds slip as strength does, but for a creep.
TEST(PlaneGrid, FrictionThatRisesSteeplyLetsSlipCreep) {
  Problem p = bump(0, 0.5);
  for (const friction::Definition* law : friction::laws())
    if (law->name == "power") p.friction = friction::Friction(*law, {30, 0.1});
  const auto solver = plane::grid_solver(p, 40);
  solver->advance_to(0.5, {});
  const double crept = -solver->slip({{0, 0}}).front();
  EXPECT_GT(crept, 0);
  EXPECT_LT(crept, 1e-3);
  EXPECT_GT(solver->energies().dissipated, 0);
}

void expect_the_same_bits(const Problem& p) {
  expect_the_same_bits_when_resumed([&] { return plane::grid_solver(p, 40); }, *plane::grid_solver(p, 48));
}

/// A run that was saved at an output time, before its observers looked, gives them the same bits.
TEST(PlaneGrid, ObserversOfAResumedRunSeeTheSameBits) {
  for (const Problem& p : {barrier(), weakening(), ageing(), friction_on_one_side()}) {
    const auto whole = plane::grid_solver(p, 40);
    const auto resumed = plane::grid_solver(p, 40);
    std::string state;
    whole->advance_to(0.2, [&] {
      state = saved(*whole);
      return false;
    });
    restore(*resumed, state);
    EXPECT_TRUE(resumed->advance_to(0.2, {}));
    EXPECT_EQ(resumed->potency_rate(), whole->potency_rate());
    EXPECT_EQ(resumed->energies().kinetic, whole->energies().kinetic);
    EXPECT_EQ(resumed->energies().elastic, whole->energies().elastic);
    EXPECT_EQ(resumed->field(20, 20).velocity, whole->field(20, 20).velocity);
    EXPECT_EQ(saved(*resumed), saved(*whole));
  }
}

TEST(PlaneGrid, ResumesToTheSameBits) {
  for (const Problem& p : {barrier(), weakening(), ageing()}) expect_the_same_bits(p);
}

TEST(PlaneGrid, ThreadsDoNotChangeTheBits) {
  for (const Problem& p : {barrier(), weakening(), ageing(), friction_on_one_side()}) {
    const auto one = plane::grid_solver(p, 40), three = plane::grid_solver(p, 40, 3);
    for (const auto* solver : {&one, &three}) (*solver)->advance_to(0.2, {});
    EXPECT_EQ(saved(*three), saved(*one));
  }
}

std::string grid_message_of(const Problem& problem, int cells = 20) {
  try {
    const auto solver = plane::grid_solver(problem, cells);
    solver->advance_to(5, {});
  } catch (const std::exception& error) {
    return error.what();
  }
  return "";
}

TEST(PlaneGrid, RefusesWhatItCannotSolve) {
  Problem negative = bump(0, 1), none = bump(0, 1), steep = barrier(), edges = bump(0, 1);
  negative.slip = [](double, double) { return -1.0; };
  none.slip = [](double, double) { return 0.0; };
  steep.hold = true;
  edges.slip = [](double, double) { return 1.0; };
  edges.edges = plane::Edges::fixed;
  EXPECT_NE(grid_message_of(negative).find("the slip is -1"), std::string::npos);
  EXPECT_NE(grid_message_of(none).find("there is no slip"), std::string::npos);
  EXPECT_NE(grid_message_of(steep).find("a static load would be infinite"), std::string::npos);
  EXPECT_NE(grid_message_of(edges).find("has no such edges"), std::string::npos);
  Problem unseen = bump(0, 1);
  unseen.fixed = [](double x, double y) { return std::hypot(x - 2.1, y - 2.1) < 0.1 ? 1.0 : 0.0; };
  EXPECT_NE(grid_message_of(unseen, 21).find("lies between the centres"), std::string::npos);
  EXPECT_NE(grid_message_of(barrier()).find("the front has reached the edge"), std::string::npos);
}

}  // namespace
