// Cells at rest, which no wave has reached yet.

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "averages/pulse/solver.hpp"
#include "averages/pulse/space/semidiscrete.hpp"
#include "slipfront/averages/pulse/run.hpp"

namespace {

using namespace slipfront;
using namespace slipfront::pulse;

Problem step(const friction::Friction& friction) {
  return {.stress = [](double x) { return x < 0 ? 0.855 : 0.0; },
          .forcing = {},
          .friction = friction,
          .left = -3,
          .right = 1,
          .cells = 200};
}

/// Rounding moves no cell ahead of the wave, so widths have the same bits as at the start. Without the limit on
/// pressure differences, each cell had a momentum after a few steps.
TEST(CellsAtRest, StayAtRestToTheBit) {
  Solver solver(step(friction::coulomb(0.03)));
  const Cells start = solver.cells();
  solver.advance_to(1);
  std::size_t resting = 0;
  while (solver.cells().momentum(resting) == 0 && solver.cells().width(resting) == start.width(resting)) ++resting;
  EXPECT_GT(resting, 80u);
  EXPECT_LT(resting, 180u);
  // Only cells that the wave cannot have reached are at rest. It is as fast as the characteristic, at most 1.
  EXPECT_GT(solver.view().faces[resting], -1.0);
}

/// A step may skip cells at rest. They have the same rates, to the bit, as in a step that computes them.
TEST(CellsAtRest, HaveTheSameRatesIfAStepSkipsThem) {
  Solver solver(step(friction::viscous(0.1)));
  for (const double time : {0.0, 1e-3, 0.1, 2.0}) {
    if (time > 0) solver.advance_to(time);
    const Cells& cells = solver.cells();
    Semidiscrete equations({.charge = cells.charge,
                            .left = Edge::continued,
                            .right = Edge::free,
                            .friction = friction::viscous(0.1),
                            .forcing = {},
                            .contact = {}});
    const std::size_t size = cells.unknowns.size();
    std::vector<double> rates(size), stage(size), whole(size), part(size);
    equations.start_from(cells.s);
    equations(time, cells.unknowns.data(), rates.data());
    const std::vector<double> s = equations.s();
    const double dt = equations.crossing_time(cells.unknowns.data(), rates.data());
    for (std::size_t i = 0; i < size; ++i) stage[i] = cells.unknowns[i] + dt * rates[i];
    equations(time + dt, stage.data(), whole.data());
    equations.start_from(s);
    equations(time, cells.unknowns.data(), rates.data());
    equations.let_rest(cells.unknowns.data(), rates.data());
    equations.start_from(s);
    equations(time + dt, stage.data(), part.data());
    EXPECT_EQ(whole, part) << time;
  }
}

/// The trains are so sparse that waves never cross a cell, and friction is steep at rest. The time step was not a
/// number.
TEST(CellsAtRest, StayFiniteInSparseTrains) {
  Problem problem = step(friction::power(1e-8, 0.5));
  problem.stress = [](double x) { return x < 0 ? 0.004703 : 0.0045001; };
  problem.left = -1e-287;
  problem.right = 1e-287;
  problem.cells = 40;
  pulse::Run run(problem, {.times = {0, 0.2}, .x_edges = {-1e-287, 0, 1e-287}});
  EXPECT_TRUE(run.go());
  EXPECT_TRUE(std::isfinite(run.snapshots().back().slip_at_origin));
}

/// Runs begin at t = 0, and a forcing such as sqrt(t) is not defined for t < 0.
TEST(CellsAtRest, EvaluateNoForcingBeforeTimeZero) {
  for (const double C : {0.0, 0.2, 1e4}) {
    Problem problem = step(friction::viscous(C));
    double earliest = 0;
    problem.forcing = [&earliest](double, double t) {
      earliest = std::fmin(earliest, t);
      return -0.05 * std::sqrt(std::fabs(t));
    };
    Solver(problem).advance_to(0.05);
    EXPECT_EQ(earliest, 0) << C;
  }
}

/// The train begins at x = 0 except for a rounding error. No cell may have the width of that error.
TEST(CellsAtRest, AreWiderThanRoundingErrors) {
  Problem problem = step(friction::viscous(0));
  problem.stress = [](double x) { return x < -1e-16 ? 0.0 : 0.855; };
  problem.corner = 0;
  const Solver solver(problem);
  for (std::size_t i = 0; i < solver.size(); ++i) EXPECT_GT(solver.cells().width(i), 1e-9) << i;
}

}  // namespace
