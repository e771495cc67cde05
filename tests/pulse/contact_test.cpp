// A contact ratio that varies along the interface: equilibrium, motion of dilute trains, and arrest of the pulse.

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

#include "averages/pulse/solver.hpp"
#include "slipfront/error.hpp"
#include "slipfront/math/elliptic.hpp"
#include "slipfront/theory/train.hpp"
#include "theory/rupture/inverse.hpp"

namespace {

using namespace slipfront;
using namespace slipfront::pulse;
using friction::Friction;
using std::numbers::pi;

/// The energy of a dislocation in a train at rest with contact ratio 1, over that of an isolated one: cosh psi E.
double energy(double psi) { return std::cosh(psi) * elliptic::at_psi(psi).E; }

/// Trains at rest are in equilibrium if they have the same wave action flux a cosh psi E.
double psi_of_energy(double wanted) {
  double low = 1e-12, high = 3;
  for (int i = 0; i < 200; ++i) {
    const double middle = (low + high) / 2;
    (energy(middle) < wanted ? low : high) = middle;
  }
  return low;
}

double fastest(const Solver& s) {
  double fastest = 0;
  for (const State& state : s.view().states) fastest = std::fmax(fastest, std::fabs(state.phi));
  return fastest;
}

Problem equilibrium(double C, int cells) {
  const auto contact = [](double x) { return 1 + 0.05 * std::exp(-x * x); };
  return {.stress =
              [=](double x) {
                const double a = contact(x);
                return a * train::stress_at_rest(psi_of_energy(1.2 / a));
              },
          .forcing = {},
          .contact = contact,
          .friction = friction::viscous(C),
          .left = -5,
          .right = 5,
          .corner = HUGE_VAL,
          .cells = cells};
}

TEST(Contact, EquilibriumStaysAtRest) {  // to the order of the scheme
  double moved[3];
  int i = 0;
  for (const int cells : {100, 200, 400}) {
    Solver s(equilibrium(0, cells));
    s.advance_to(2 * pi);
    moved[i++] = fastest(s);
  }
  EXPECT_LT(moved[1], moved[0] / 16);
  EXPECT_LT(moved[2], moved[1] / 16);
  EXPECT_LT(moved[1], 1e-7);
}

TEST(Contact, EquilibriumStaysAtRestUnderStrongFriction) {
  double last = 1;
  for (const int cells : {50, 100, 200}) {
    Solver s(equilibrium(1e4, cells));
    s.advance_to(2 * pi);
    EXPECT_LT(fastest(s), last / 3.5) << cells;
    last = fastest(s);
  }
}

/// The position after a time of an isolated dislocation that starts at rest: H = ((8 a)^2 + p^2)^(1/2).
double position_after(double x, double time, const std::function<double(double)>& contact) {
  constexpr int steps = 2000;
  constexpr double h = 1e-5;
  double p = 0;
  const double dt = time / steps;
  for (int i = 0; i < steps; ++i) {  // kick, drift, kick
    const auto kick = [&] {
      const double a = contact(x), slope = (contact(x + h) - contact(x - h)) / (2 * h);
      p -= dt / 2 * 64 * a * slope / std::hypot(8 * a, p);
    };
    kick();
    x += dt * p / std::hypot(8 * contact(x), p);
    kick();
  }
  return x;
}

/// Dislocations that are far apart slide down a slope of the contact ratio like isolated ones, even where the stress
/// changes and phi is much larger than psi.
TEST(Contact, DiluteTrainSlidesLikeSingleDislocations) {
  const auto contact = [](double x) { return 1 + 0.139 * std::exp(-std::pow((x - 0.724) / 0.824, 2)); };
  const auto stress = [](double x) { return 0.261 + 0.434 / (1 + std::exp(2 * x / 0.58)); };
  constexpr double end = 0.5;
  Solver solver({.stress = stress,
                 .forcing = {},
                 .contact = contact,
                 .friction = Friction(),
                 .left = -5.12,
                 .right = 5.12,
                 .corner = HUGE_VAL,
                 .cells = 400});
  solver.advance_to(end);
  for (const double from : {1.1, 1.2, 1.3, 1.5, 1.7}) {
    const double x = position_after(from, end, contact);
    double passed = 0;  // slip at x: 2 pi for each dislocation that started between
    for (int i = 0; i < 100; ++i) passed += stress(from + (i + 0.5) / 100 * (x - from)) * (x - from) / 100;
    EXPECT_NEAR(solver.slip_at(solver.view(), x), passed, 2e-3 * passed) << x;
  }
}

/// The last dislocation of such a train, where the stress falls to zero, also slides like an isolated one.
TEST(Contact, EdgeOfADiluteTrainSlidesLikeOneDislocation) {
  const auto contact = [](double x) { return 1 + 0.566 * std::tanh((x + 0.6) / 1.54); };
  for (const int cells : {100, 200}) {
    Solver solver({.stress =
                       [&](double x) {
                         const double stress = 0.276 / (1 + std::exp((x + 1.09) / 0.232));
                         return stress < 0.005 * contact(x) ? 0 : stress;
                       },
                   .forcing = {},
                   .contact = contact,
                   .friction = Friction(),
                   .left = -2.81,
                   .right = 2.61,
                   .corner = HUGE_VAL,
                   .cells = cells});
    const double edge = solver.view().faces.back();
    solver.advance_to(0.524);
    EXPECT_NEAR(solver.view().faces.back(), position_after(edge, 0.524, contact), 1e-3) << cells;
    const auto view = solver.view();
    for (std::size_t i = solver.size() - 10; i < solver.size(); ++i)
      EXPECT_LE(std::fabs(view.states[i].phi - view.states[i - 1].phi), 0.01) << cells << " cells, cell " << i;
  }
}

/// Under strong friction, a dense train creeps down a slope of the contact next to a sparse one, which hardly resists.
/// The sparse train reaches x = 0 long before the cells resolve this. The slip at x = 0 is -7.674e-5 with 12,800 cells.
TEST(Contact, SparseTrainNextToADenseOneCreepsWithTheRightSlip) {
  for (const int cells : {50, 100, 200}) {
    Solver s({.stress = [](double x) { return x < 0 ? 0.255 : 0.0463; },
              .forcing = {},
              .contact = [](double x) { return 1 + 0.212 * std::tanh((x - 1.97) / 1.29); },
              .friction = friction::viscous(181),
              .left = -12.3,
              .right = 8.96,
              .cells = cells});
    s.advance_to(8.56);
    const auto view = s.view();
    EXPECT_NEAR(s.slip_at(view, 0), -7.674e-5, 4e-7) << cells;
    EXPECT_NEAR(averages_of(view, state_at(view, 0), 0).k, 0.0463, 3e-4) << cells;
  }
}

/// The free edge of this pulse runs over a slope of the contact. slip(0) of chains at scale 1000 and 4000 is 0.07926
/// and 0.07954.
TEST(Contact, FreeEdgeOnASlopeConverges) {
  double slip[3];
  int i = 0;
  for (const int cells : {100, 200, 400}) {
    Solver s({.stress = [](double x) { return x < 0 ? 0.855 : 0.0; },
              .forcing = {},
              .contact = [](double x) { return 1 + 0.2 * std::tanh(x - 1); },
              .friction = Friction(),
              .left = -7,
              .right = 7,
              .cells = cells});
    s.advance_to(2 * pi);
    slip[i++] = s.slip_at(s.view(), 0);
  }
  EXPECT_LT(std::fabs(slip[2] - slip[1]), std::fabs(slip[1] - slip[0]) / 3);
  EXPECT_NEAR(slip[2], 0.07963, 2e-5);
}

/// At the end the train is at rest, in equilibrium near the barrier. At the edge of the empty side, an isolated
/// dislocation has the energy of each one behind it: a(x) there equals a cosh psi E elsewhere.
TEST(Contact, BarrierArrestsThePulse) {
  const auto contact = [](double x) { return 1 + 0.5 * (1 + std::tanh((x - 0.3) / 0.05)); };
  for (const double C : {2.0, 1e4}) {
    Solver s({.stress = [](double x) { return x < 0 ? 0.855 : 0.0; },
              .forcing = {},
              .contact = contact,
              .friction = friction::viscous(C),
              .left = -3,
              .right = 2,
              .cells = 100});
    s.advance_to(20 * C);
    const auto view = s.view();
    const std::size_t behind = s.size() - 1 - s.size() / 10;
    const double carried = contact(view.centres[behind]) * energy(view.states[behind].psi);
    EXPECT_NEAR(view.faces.back(), 0.3 + 0.05 * std::atanh(2 * (carried - 1) - 1), 2e-4) << C;
    EXPECT_LT(view.faces.back(), 0.2);
  }
}

TEST(Contact, RefusesJumpsAndContactWithoutAState) {
  Problem p = equilibrium(0, 50);
  p.contact = [](double x) { return x > 0.3 ? 2.0 : 1.0; };
  EXPECT_THROW(Solver{p}, InputError);
  p.contact = [](double) { return 1e4; };
  EXPECT_THROW(Solver{p}, InputError);
  p.contact = [](double x) { return 1 + std::fabs(x); };  // a corner is not a jump
  EXPECT_NO_THROW(Solver{p});
}

}  // namespace
