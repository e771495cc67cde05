#include "theory/modulation/equations.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "averages/pulse/space/kernels.hpp"
#include "slipfront/theory/modulation/modulation.hpp"
#include "slipfront/theory/train.hpp"

namespace {

using namespace slipfront;

struct Trains {
  std::vector<double> phi, psi;
};
Trains trains() {
  Trains all;
  for (const double phi : {-300.0, -18.0, -1.0, -1e-3, -1e-17, 0.0, 1e-300, 1e-9, 0.1, 0.7, 5.0, 40.0})
    for (int i = 0; i < 100; ++i) {
      all.phi.push_back(phi * (1 + i * 1e-3));
      all.psi.push_back(std::pow(10.0, -300 + 3.025 * i));
    }
  return all;
}

/// Compares the loop of the solver with the functions of the theory in extended precision.
TEST(Equations, OfTheSolverAreThoseOfTheTheory) {
  const Trains t = trains();
  const std::size_t n = t.phi.size();
  std::vector<double> U(n), p(n);
  pulse::face_fluxes(n, t.phi.data(), t.psi.data(), 0, U.data(), p.data());
  for (std::size_t i = 0; i < n; ++i) {
    const long double phi = t.phi[i], sinh = std::sinh(static_cast<long double>(t.psi[i]));
    const auto exact_U = static_cast<double>(std::tanh(phi)), exact_p = static_cast<double>(2 * sinh * sinh);
    EXPECT_NEAR(U[i], exact_U, 4e-16 * std::fabs(exact_U)) << t.phi[i];
    EXPECT_NEAR(p[i], exact_p, exact_p > 1e-290 ? 2e-15 * exact_p : 1e-290) << t.psi[i];
  }
}

/// Velocities below the rounding of a train are 0, so that a train at rest stays at rest.
TEST(Equations, OfTheSolverHaveNoVelocityBelowTheRounding) {
  const std::vector<double> phi{1e-17, 3e-17, -1e-17, -3e-17, 0.5}, psi(5, 0.2);
  std::vector<double> U(5), p(5);
  pulse::face_fluxes(5, phi.data(), psi.data(), 1e-16, U.data(), p.data());
  EXPECT_EQ(U[0], 0);
  EXPECT_EQ(U[1], 3e-17);
  EXPECT_EQ(U[2], 0);
  EXPECT_EQ(U[3], -3e-17);
  EXPECT_NEAR(U[4], std::tanh(0.5), 1e-16);
}

TEST(Equations, AreTheHyperbolicFunctionsOfTheTheory) {
  const Trains t = trains();
  for (std::size_t i = 0; i < t.phi.size(); ++i) {
    const double U = std::tanh(t.phi[i]), sinh = std::sinh(t.psi[i]), p = 2 * sinh * sinh;
    EXPECT_NEAR(modulation::velocity(t.phi[i]), U, 4e-16 * std::fabs(U));
    if (p > 1e-290) {
      EXPECT_NEAR(modulation::pressure(t.psi[i]), p, 2e-15 * p);
    }
  }
}

/// The average momentum flux is (1 + U^2) <sigma^2> / 2 - <1 - cos u>.
TEST(Equations, GiveTheAverageMomentumFluxOfATrain) {
  for (const State s : {State{0.3, 0.5}, State{-1.2, 2.0}, State{0.01, 1e-3}, State{2.0, 0.1}}) {
    const train::Averages a = train::averages(s);
    const double U = std::tanh(s.phi), averaged = (1 + U * U) / 2 * a.sigma2 - a.one_minus_cos;
    EXPECT_NEAR(modulation::flux(s).momentum, averaged, 1e-13 * (a.sigma2 + a.one_minus_cos));
    EXPECT_NEAR(modulation::flux(s).number, a.W, 1e-14 * std::fabs(a.W));
  }
}

TEST(Equations, GiveJumpsAsDifferencesOfTheFluxes) {
  for (const double a : {0.1, 0.5, 2.0})
    for (const double b : {0.2, 1.0, 3.0}) {
      EXPECT_NEAR(modulation::velocity_jump(a, b - a), modulation::velocity(b) - modulation::velocity(a), 1e-15);
      EXPECT_NEAR(modulation::pressure_jump(a, b, 0.5), 4 * (modulation::pressure(b) - modulation::pressure(a)), 1e-11);
    }
  EXPECT_NEAR(modulation::velocity_jump(1, 1e-12) / (1e-12 / std::pow(std::cosh(1.0), 2)), 1, 1e-11);
}

TEST(Equations, IntegrateTheContactForceOfAParabola) {
  // A cell from -1 to 1 has a^2 = 1 + x + x^2 / 2 and <1 - cos u> = 2 - x, so the force is -integral of (2 - x)(1 + x).
  const modulation::AcrossCell substrate{3, 2, 1}, a2{0.5, 1, 2.5};
  EXPECT_NEAR(modulation::contact_source(substrate, a2), -(4.0 - 2.0 / 3), 1e-14);
}

/// The source of a contact profile is the integral of -<1 - cos u> (a^2)_x. It is exact for quadratic functions, here
/// over -1 < x < 1: (1 + 0.3 x + 0.2 x^2) (0.5 - 0.8 x) has the integral 1 - 0.28 / 3.
TEST(Equations, ContactSourceIsTheIntegralOverTheCell) {
  const auto substrate = [](double x) { return 1 + 0.3 * x + 0.2 * x * x; };
  const auto a2 = [](double x) { return 2 + 0.5 * x - 0.4 * x * x; };
  EXPECT_NEAR(modulation::contact_source({substrate(-1), substrate(0), substrate(1)}, {a2(-1), a2(0), a2(1)}),
              -(1 - 0.28 / 3), 1e-15);
}

TEST(Equations, PressureFollowsFromTheExponential) {
  for (const double psi : {1e-9, 0.2, 1.5, 4.0}) {
    const double p = 2 * std::sinh(psi) * std::sinh(psi);
    EXPECT_NEAR(modulation::pressure_from(std::expm1(2 * psi)), p, 1e-15 * p);
  }
}

}  // namespace
