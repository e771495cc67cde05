#include "modulation/equations.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "foundation/simd/vector_code.hpp"
#include "pulse/space/kernels.hpp"
#include "slipfront/modulation/conservation.hpp"
#include "slipfront/train/train.hpp"

namespace {

using namespace slipfront;

/// Computes the fluxes by the documented equations. It is compiled for the same processors as the loops of the solver.
SLIPFRONT_CLONES void documented_fluxes(std::size_t size, const double* phi, const double* psi, double* U, double* p) {
  SLIPFRONT_INDEPENDENT
  for (std::size_t i = 0; i < size; ++i) {
    const modulation::Fluxes at = modulation::fluxes(phi[i], psi[i]);
    U[i] = at.velocity;
    p[i] = at.pressure;
  }
}

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

TEST(Equations, AgreeWithTheFluxesOfTheSolverToTheLastBit) {
  const Trains t = trains();
  const std::size_t n = t.phi.size();
  std::vector<double> U(n), p(n), documented_U(n), documented_p(n);
  pulse::face_fluxes(n, t.phi.data(), t.psi.data(), 0, U.data(), p.data());
  documented_fluxes(n, t.phi.data(), t.psi.data(), documented_U.data(), documented_p.data());
  for (std::size_t i = 0; i < n; ++i) {
    EXPECT_EQ(U[i], documented_U[i]) << t.phi[i];
    EXPECT_EQ(p[i], documented_p[i]) << t.psi[i];
  }
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

}  // namespace
