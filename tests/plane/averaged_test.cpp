#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

#include "resumed.hpp"
#include "rings.hpp"
#include "slipfront/error.hpp"
#include "slipfront/lattice/plane/run.hpp"
#include "slipfront/lattice/plane/solvers.hpp"
#include "system/archive.hpp"

namespace {

using namespace slipfront;
using plane::Point;
using plane::Problem;
using rings::polar;

const rings::Slip& slip_of_rings() {
  static const rings::Slip slip;
  return slip;
}

/// Slip and front of the rings agree with those of 4365 rings, followed one by one by the radial sine-Gordon equation.
TEST(PlaneAveraged, RingsAgreeWithEveryRing) {
  const auto solver = plane::loops_solver(rings::problem(slip_of_rings()), {60, 1});
  EXPECT_TRUE(solver->advance_to(1, {}));
  const std::vector<double> slip = solver->slip({polar(1.25, 0), polar(1.65, 0), polar(2.05, 0)});
  EXPECT_NEAR(slip[0] / 0.10733, 1, 0.01);
  EXPECT_NEAR(slip[1] / 0.34079, 1, 0.003);
  EXPECT_NEAR(slip[2] / 0.45870, 1, 0.003);
  EXPECT_NEAR(solver->front(1) / 2.4606, 1, 0.003);
}

TEST(PlaneAveraged, RingsWithFrictionAgreeWithEveryRing) {
  Problem problem = rings::problem(slip_of_rings());
  problem.friction = friction::viscous(0.5);
  const auto solver = plane::loops_solver(problem, {60, 1});
  solver->advance_to(3, {});
  const std::vector<double> slip = solver->slip({polar(1.45, 0), polar(2.05, 0)});
  EXPECT_NEAR(slip[0] / 0.40487, 1, 0.01);
  EXPECT_NEAR(slip[1] / 0.72095, 1, 0.01);
  EXPECT_NEAR(solver->front(1) / 2.7887, 1, 0.01);
}

/// The paper's closure takes C W from the wave action, the consistent one C I. A power law with nearly the exponent 1
/// takes another path through the module friction.
TEST(PlaneAveraged, ViscousFrictionFollowsItsClosure) {
  const auto loops = [](const friction::Friction& friction) {
    Problem problem = rings::problem(slip_of_rings());
    problem.friction = friction;
    const auto solver = plane::loops_solver(problem, {30, 1});
    solver->advance_to(1, {});
    return solver->potency();
  };
  const auto grid = [](const friction::Friction& friction) {
    Problem problem = rings::problem(slip_of_rings());
    problem.friction = friction;
    const auto solver = plane::grid_solver(problem, 50);
    solver->advance_to(1, {});
    return solver->potency();
  };
  const auto paper = friction::Closure::paper, consistent = friction::Closure::consistent;
  const double by_paper = loops(friction::viscous(0.5, paper));
  EXPECT_NEAR(by_paper / loops(friction::power(0.5, 1 + 1e-9, paper)), 1, 1e-6);
  const double ratio = by_paper / loops(friction::viscous(0.5, consistent));
  EXPECT_GT(ratio, 1.025);
  EXPECT_NEAR(grid(friction::viscous(0.5, paper)) / grid(friction::viscous(0.5, consistent)), ratio,
              0.25 * (ratio - 1));
}

/// With both closures.
TEST(PlaneAveraged, CoefficientAtAPositionMultipliesTheForce) {
  for (const auto closure : {friction::Closure::consistent, friction::Closure::paper}) {
    Problem whole = rings::problem(slip_of_rings()), shared = whole;
    whole.friction = friction::viscous(0.5, closure);
    shared.friction = friction::viscous(1, closure).with("coefficient", {[](double, double) { return 0.5; }, 0.5, 0.5});
    const auto a = plane::loops_solver(whole, {30, 1});
    const auto b = plane::loops_solver(shared, {30, 1});
    a->advance_to(1, {});
    b->advance_to(1, {});
    EXPECT_NEAR(a->potency() / b->potency(), 1, 1e-12);
  }
}

/// Errors of the slip fall at least as the power 1.5 of the size of the cells, and those of the front at least
/// linearly.
TEST(PlaneAveraged, RingsConverge) {
  const auto run = [](int loops) {
    const auto solver = plane::loops_solver(rings::problem(slip_of_rings()), {loops, 1});
    solver->advance_to(1, {});
    return std::pair(solver->slip({polar(1.25, 0)}).front(), solver->front(1));
  };
  const auto coarse = run(30), middle = run(60), fine = run(480);
  EXPECT_GT(std::fabs(coarse.first - fine.first), 2.8 * std::fabs(middle.first - fine.first));
  EXPECT_GT(std::fabs(coarse.second - fine.second), 2 * std::fabs(middle.second - fine.second));
}

/// The kinetic energy that the rings gain is elastic energy that they lose, up to the expansion of the first steps.
TEST(PlaneAveraged, EnergyIsKept) {
  double before = HUGE_VAL;
  for (const int loops : {60, 120, 240}) {
    const auto solver = plane::loops_solver(rings::problem(slip_of_rings()), {loops, 1});
    solver->advance_to(1, {});
    const plane::Energies e = solver->energies();
    const double error = std::fabs(e.kinetic + e.elastic) / e.kinetic;
    EXPECT_LT(error, 2.5e-3);
    EXPECT_LT(error, before);
    before = error;
  }
}

/// The largest difference of the slip velocities at points from the rates of the slip there, over the largest velocity.
double error_of_velocities(plane::Solver& solver) {
  const std::vector<Point> points{polar(1.25, 0), polar(1.5, 40), polar(1.83, 110), polar(2.1, 250)};
  constexpr double apart = 1e-3;
  solver.advance_to(0.5, {});
  const std::vector<double> before = solver.slip(points);
  solver.advance_to(0.5 + apart, {});
  const std::vector<double> velocity = solver.velocity(points);
  solver.advance_to(0.5 + 2 * apart, {});
  const std::vector<double> after = solver.slip(points);
  double error = 0, largest = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    error = std::fmax(error, std::fabs((after[i] - before[i]) / (2 * apart) - velocity[i]));
    largest = std::fmax(largest, std::fabs(velocity[i]));
  }
  return error / largest;
}

TEST(PlaneAveraged, VelocitiesAreRatesOfTheSlip) {
  const auto loops = plane::loops_solver(rings::problem(slip_of_rings()), {120, 1});
  EXPECT_LT(error_of_velocities(*loops), 0.013);
  const auto grid = plane::grid_solver(rings::problem(slip_of_rings()), 60);
  EXPECT_LT(error_of_velocities(*grid), 0.02);
}

/// A force supplies the energy that the rings gain.
TEST(PlaneAveraged, AForceSuppliesItsWork) {
  Problem problem = rings::problem(slip_of_rings());
  problem.forcing = [](double, double, double) { return 0.8; };
  const auto solver = plane::loops_solver(problem, {120, 1});
  solver->advance_to(0.7, {});
  const plane::Energies e = solver->energies();
  EXPECT_GT(e.supplied, 0.3 * e.kinetic);
  EXPECT_NEAR((e.kinetic + e.elastic) / e.supplied, 1, 5e-3);
}

/// Without symmetry: friction on one side. The direct run has the scale 160 and averages over boxes.
TEST(PlaneAveraged, FrictionOnOneSideAgreesWithEveryLine) {
  Problem problem = rings::problem(slip_of_rings());
  problem.friction = friction::viscous(1).with("coefficient", {rings::friction_on_one_side, 0, 2});
  const auto solver = plane::loops_solver(problem, {60, 64});
  solver->advance_to(1, {});
  const std::vector<double> slip =
      solver->slip({polar(1.6, 90), polar(1.6, 0), polar(1.6, -90), polar(2.2, 0), polar(2.2, -90)});
  const std::vector<double> direct = {0.17662, 0.23793, 0.30931, 0.17312, 0.2655};
  for (std::size_t i = 0; i < slip.size(); ++i) EXPECT_NEAR(slip[i] / direct[i], 1, 0.02) << i;
  EXPECT_NEAR(solver->potency() / 3.1787, 1, 0.01);
}

/// Directions do not matter to a problem without any: 48 angles give the rings.
TEST(PlaneAveraged, AnglesGiveTheRings) {
  const auto ring = plane::loops_solver(rings::problem(slip_of_rings()), {20, 1});
  const auto plane = plane::loops_solver(rings::problem(slip_of_rings()), {20, 48});
  ring->advance_to(0.5, {});
  plane->advance_to(0.5, {});
  EXPECT_NEAR(plane->front(1) / ring->front(1), 1, 2e-4);
  EXPECT_NEAR(plane->potency() / ring->potency(), 1, 2e-3);
}

TEST(PlaneAveraged, ResumesToTheSameBits) {
  Problem problem = rings::problem(slip_of_rings());
  problem.friction = friction::viscous(1).with("coefficient", {rings::friction_on_one_side, 0, 2});
  expect_the_same_bits_when_resumed(
      [&] {
        return plane::loops_solver(problem, {20, 32});
      },
      *plane::loops_solver(problem, {10, 32}));
}

std::string loops_message_of(const Problem& problem) {
  try {
    const auto solver = plane::loops_solver(problem, {20, 16});
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

TEST(PlaneAveraged, RefusesLinesThatAreNotStarShaped) {
  Problem problem = rings::problem(slip_of_rings());
  problem.slip = [](double x, double y) { return std::hypot(x, y) < 3 ? 1 + x * x : 0; };
  EXPECT_NE(loops_message_of(problem).find("rises away from the origin"), std::string::npos)
      << loops_message_of(problem);
  problem.slip = [](double, double) { return 1; };
  EXPECT_NE(loops_message_of(problem).find("at the edge of the domain"), std::string::npos)
      << loops_message_of(problem);
  problem.slip = [](double x, double) { return x > 2.5 ? 0 : NAN; };
  EXPECT_NE(loops_message_of(problem).find("there is no slip around the origin"), std::string::npos)
      << loops_message_of(problem);
  problem = rings::problem(slip_of_rings());
  problem.fixed = [](double x, double y) { return std::hypot(x - 2, y) < 0.3 ? 1 : 0; };
  EXPECT_NE(loops_message_of(problem).find("is not around the origin"), std::string::npos) << loops_message_of(problem);
}

TEST(PlaneAveraged, RunsWithTheFewestCells) {
  const auto least = plane::loops_solver(rings::problem(slip_of_rings()), {4, 8});
  least->advance_to(0.1, {});
  EXPECT_GT(least->slip({polar(2.02, 0)}).front(), 0);
}

/// Friction takes the elastic energy that the lines release, and no more.
TEST(PlaneAveraged, StrongFrictionKeepsTheBudget) {
  Problem problem = rings::problem(slip_of_rings());
  problem.friction = friction::viscous(10);
  const auto solver = plane::loops_solver(problem, {60, 1});
  solver->advance_to(1, {});
  const plane::Energies e = solver->energies();
  EXPECT_NEAR(e.dissipated / -e.elastic, 1, 0.05);
}

TEST(PlaneAveraged, StopsWhereFrictionTakesEnergyFromNothing) {
  Problem problem = rings::problem(slip_of_rings());
  problem.friction = friction::viscous(1000);
  const auto solver = plane::loops_solver(problem, {60, 1});
  EXPECT_THROW(solver->advance_to(1, {}), NumericsError);
}

TEST(PlaneAveraged, RefusesStrengthAtRest) {
  Problem problem = rings::problem(slip_of_rings());
  problem.friction = friction::coulomb(0.3);
  EXPECT_NE(loops_message_of(problem).find("holds slip at rest"), std::string::npos) << loops_message_of(problem);
}

TEST(PlaneAveraged, StopsWhereTheFrontLeavesTheDomain) {
  Problem problem = rings::problem(slip_of_rings());
  problem.right = 2.2;
  const auto solver = plane::loops_solver(problem, {20, 16});
  EXPECT_THROW(solver->advance_to(2, {}), NumericsError);
  EXPECT_GT(solver->time(), 0.2);
}

TEST(PlaneAveraged, RefusesWhatOnlyTheLinesCanDo) {
  const auto key = [](const Problem& p) -> std::string {
    try {
      const auto solver = plane::loops_solver(p, {20, 16});
    } catch (const InputError& error) {
      return error.complaint().key;
    }
    return {};
  };
  Problem p = rings::problem(slip_of_rings());
  p.hold = true;
  EXPECT_EQ(key(p), "hold");
  p.hold = false;
  p.edges = plane::Edges::absorbing;
  EXPECT_EQ(key(p), "edges");
}

TEST(PlaneAveraged, LinesThatShrinkToTheOriginVanish) {
  // The reference is a direct radial simulation at scale 800. Within a distance of 1 its lines return from the origin.
  Problem p;
  p.left = p.bottom = -4;
  p.right = p.top = 4;
  p.slip = [](double x, double y) {
    const double r = std::hypot(x, y);
    return r < 2 ? 8 * std::exp(-r * r) * (1 - std::exp(-10 * (2 - r))) : 0;
  };
  const auto solver = plane::loops_solver(p, {.loops = 120, .angles = 1});
  EXPECT_TRUE(solver->warnings().empty());
  solver->advance_to(1, {});
  const std::vector<double> slip = solver->slip({{1, 0}, {1.5, 0}});
  EXPECT_NEAR(slip[0] / -0.67859, 1, 0.005);
  EXPECT_NEAR(slip[1] / 0.7403, 1, 0.012);
  EXPECT_NEAR(solver->front(1) / 2.3076, 1, 0.005);
  ASSERT_EQ(solver->warnings().size(), 1U);
  EXPECT_NE(solver->warnings()[0].find("closer to the origin than 0.99"), std::string::npos) << solver->warnings()[0];
  const auto e = solver->energies();
  EXPECT_GT(e.vanished, 0);
  EXPECT_LT(std::fabs(e.kinetic + e.elastic + e.vanished), 0.01 * e.kinetic);

  const auto resumed = plane::loops_solver(p, {.loops = 120, .angles = 1});
  restore(*resumed, saved(*solver));
  solver->advance_to(1.2, {});
  resumed->advance_to(1.2, {});
  EXPECT_EQ(saved(*solver), saved(*resumed));
}

std::string end_of(std::unique_ptr<plane::Solver> solver, double end) {
  plane::Run run(std::move(solver), {.times = {0, end}, .nx = 8, .ny = 8, .interval = end, .rupture_slip = 1e-3});
  try {
    run.go();
  } catch (const NumericsError& error) {
    return error.what();
  }
  return "no error";
}

/// Steps of averages are a fraction of the time in which friction stops the lines. The run ends before the first of
/// them.
TEST(PlaneRun, EndsAtOnceIfFrictionRequiresFarMoreStepsThanWaves) {
  Problem problem = rings::problem(slip_of_rings());
  for (const bool on_grid : {false, true}) {
    const auto solver = [&](double C) -> std::unique_ptr<plane::Solver> {
      problem.friction = friction::viscous(C);
      if (on_grid) return plane::grid_solver(problem, 16);
      return plane::loops_solver(problem, {.loops = 4, .angles = 1});
    };
    const std::string text = end_of(solver(1e7), 0.05);
    EXPECT_NE(text.find("t = 0: given up after 0 steps"), std::string::npos) << text;
    EXPECT_NE(text.find("Friction stops the lines at x = "), std::string::npos) << text;
    EXPECT_NE(text.find("in a time of 1e-07"), std::string::npos) << text;
    EXPECT_NE(text.find("so that the run would take "), std::string::npos) << text;
    EXPECT_EQ(end_of(solver(0.5), 0.05), "no error");
  }
}

/// Four cells of strongly damped lines move by the errors of the cells.
TEST(PlaneRun, LosingNearlyAllEnergyIsAnError) {
  Problem problem = rings::problem(slip_of_rings());
  problem.friction = friction::viscous(1e3);
  const std::string text = end_of(plane::loops_solver(problem, {.loops = 4, .angles = 1}), 0.05);
  EXPECT_NE(text.find("t = 0.05: the balance of energy lacks 9"), std::string::npos) << text;
}

/// The two outermost lines would have one distance from the origin if both were taken to have a millionth of the slip.
TEST(PlaneAveraged, ManyLoopsBeginApart) {
  for (const int loops : {1000, 2000, 5000}) {
    const auto solver = plane::loops_solver(rings::problem(slip_of_rings()), {loops, 1});
    EXPECT_NO_THROW(solver->advance_to(1e-7, {})) << loops;
  }
}

}  // namespace
