// A contact ratio that varies along the interface: where the pulse stops, and what stays at rest.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "slipfront/elliptic/complete.hpp"
#include "slipfront/error.hpp"
#include "slipfront/pulse/solver.hpp"
#include "slipfront/rupture/inverse.hpp"
#include "slipfront/train/train.hpp"

namespace {

using namespace slipfront;
using namespace slipfront::pulse;
using friction::Friction;
using std::numbers::pi;

/// Energy of a dislocation in a train at rest under contact 1, over that of one alone: cosh psi E.
double energy(double psi) { return std::cosh(psi) * elliptic::at_psi(psi).E; }

/// Trains at rest are in equilibrium where a cosh psi E, their wave action flux, is the same.
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

/// At the end all is at rest in equilibrium near the barrier, and the edge of the empty side stands where a dislocation
/// alone needs the energy that each one has behind it: a(x) there is a cosh psi E anywhere else.
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

TEST(Contact, JumpsAndWhatLeavesNoStateAreRefused) {
  Problem p = equilibrium(0, 50);
  p.contact = [](double x) { return x > 0.3 ? 2.0 : 1.0; };
  EXPECT_THROW(Solver{p}, InputError);
  p.contact = [](double) { return 1e4; };
  EXPECT_THROW(Solver{p}, InputError);
  p.contact = [](double x) { return 1 + std::fabs(x); };  // a corner is none
  EXPECT_NO_THROW(Solver{p});
}

}  // namespace
