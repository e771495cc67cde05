// The effects of the ends of the domain on a train.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "averages/pulse/solver.hpp"
#include "slipfront/averages/pulse/run.hpp"
#include "slipfront/error.hpp"
#include "slipfront/theory/modulation/modulation.hpp"

namespace {

using namespace slipfront;
using namespace slipfront::pulse;
using std::numbers::pi;

Problem loaded(double C) {
  return {.stress = [](double) { return 0.8; },
          .forcing = [](double, double) { return 0.05; },
          .friction = friction::viscous(C),
          .left = -4,
          .right = 4,
          .corner = HUGE_VAL,
          .cells = 100};
}

double W(const Solver& s, double x) { return averages_of(s.view(), state_at(s.view(), x), x).W; }

/// A uniform train under F stays uniform: M' = 2 pi F - C M, independent of the pressure.
double slip_velocity_of_uniform_train(double C, double t) {
  const double momentum = C > 0 ? 2 * pi * 0.05 / C * (1 - std::exp(-C * t)) : 2 * pi * 0.05 * t;
  const State state = modulation::state_of({2 * pi / 0.8, momentum}, 0.1);
  return 0.8 * std::tanh(state.phi);
}

TEST(Ends, ContinuedEndsSupplyDislocationsToATrain) {
  for (const double C : {0.0, 0.3, 20.0}) {  // the last with momenta at the faces
    Solver continued(loaded(C));
    continued.advance_to(20);
    EXPECT_NEAR(continued.slip_at(continued.view(), 0) / continued.slip_at(continued.view(), 3.9), 1, 1e-4) << C;
    for (const double x : {-3.9, 0.0, 3.9})
      EXPECT_NEAR(W(continued, x) / slip_velocity_of_uniform_train(C, 20), 1, 1e-4) << C << " " << x;
  }
}

TEST(Ends, RingIsATrainWithoutEnds) {
  Problem p = loaded(0.3);
  p.periodic = true;
  Solver ring(p);
  ring.advance_to(20);
  for (const double x : {-3.9, 0.0, 3.9}) EXPECT_NEAR(W(ring, x) / slip_velocity_of_uniform_train(0.3, 20), 1, 1e-5);
  double charge = 0;
  for (const double q : ring.charge()) charge += q;
  EXPECT_NEAR(charge, 8 * 0.8 / (2 * pi), 1e-12);
  // A wave travels around the ring as if the stress were repeated outside the ends.
  p.forcing = {};
  p.stress = [](double x) { return 0.8 + 0.05 * std::cos(pi * x / 4); };
  Solver round(p);
  p.periodic = false;
  p.left = -12;
  p.right = 12;
  p.cells = 300;
  Solver three(p);
  round.advance_to(6);
  three.advance_to(6);
  for (const double x : {-3.0, 0.0, 2.0})
    EXPECT_NEAR(round.slip_at(round.view(), x), three.slip_at(three.view(), x), 1e-5);
  p.periodic = true;
  p.friction = friction::coulomb(0.3);
  EXPECT_NO_THROW(Solver{p});
  p.friction = friction::Friction();
  p.stress = [](double x) { return x < 0 ? 0.8 : 0.0; };
  EXPECT_THROW(Solver{p}, InputError);
}

TEST(Ends, NothingPassesAWall) {
  for (const double C : {0.3, 20.0}) {
    Problem p = loaded(C);
    p.left_end = p.right_end = End::fixed;
    Solver s(p);
    s.advance_to(200);
    const auto view = s.view();
    EXPECT_GE(view.faces.front(), -4 - 1e-9);
    EXPECT_NEAR(view.faces.back(), 4, 1e-9);
    // At last the train is at rest, and the pressure balances the load: dJ/dx = F, J = (4 / pi) cosh(psi) E.
    if (C < 1) {  // with C = 20 it still moves
      EXPECT_NEAR(W(s, 0), 0, 1e-3);
    }
    EXPECT_GT(averages_of(view, state_at(view, 3), 3).k, averages_of(view, state_at(view, -3), -3).k);
  }
}

TEST(Ends, DislocationsLeaveThroughAFreeEnd) {
  Problem p = loaded(0.3);
  p.forcing = {};
  p.left_end = p.right_end = End::free;
  Solver s(p);
  s.advance_to(30);
  EXPECT_LT(s.cells().entered_left, 0);
  EXPECT_NEAR(s.cells().entered_left, s.cells().entered_right, 1e-6);
  EXPECT_NEAR(s.slip_at(s.view(), 0), 0, 1e-6);
}

TEST(Ends, RunWithCellsThatEnteredResumesToTheSameBits) {
  const output::Schedule schedule{.times = {0, 10}, .x_edges = {-4, 0, 4}};
  pulse::Run whole(loaded(20), schedule), cut(loaded(20), schedule);
  whole.go();
  int steps = 0;
  cut.go([&] { return ++steps == 40; });
  pulse::Run resumed(loaded(20), schedule, cut.saved(), cut.snapshots());
  resumed.go();
  EXPECT_EQ(whole.saved(), resumed.saved());
}

TEST(Ends, StressAtASinglePointIsNotATrain) {
  Problem p = loaded(0);
  p.forcing = {};
  p.right = 0;
  p.stress = [](double x) { return x < 0 ? 0.0 : 0.8; };
  EXPECT_THROW(Solver{p}, InputError);
  p.right = 4;
  p.stress = [](double x) { return x == 0 || x > 1 ? 0.8 : 0.0; };
  EXPECT_EQ(Solver(p).view().faces.front(), std::nextafter(1.0, 2.0));
}

TEST(Ends, RefusesStressOnTooNarrowARange) {
  Problem p = loaded(0);
  p.forcing = {};
  const double h = (p.right - p.left) / 4096, at = p.left + 1000.3 * h;
  p.stress = [=](double x) { return x > 0 || std::fabs(x - at) < 0.2 * h ? 0.8 : 0.0; };
  EXPECT_THROW(Solver{p}, InputError);
  p.stress = [=](double x) { return x > 0 || std::fabs(x - at) < 1.2 * h ? 0.8 : 0.0; };
  EXPECT_EQ(Solver(p).cells().charge.size(), static_cast<std::size_t>(p.cells) + 1 + 4);
}

}  // namespace
