#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "slipfront/math/elliptic.hpp"
#include "slipfront/theory/modulation/modulation.hpp"
#include "theory/modulation/equations.hpp"
#include "theory/modulation/modulation.hpp"

namespace {

using namespace slipfront;

/// Trains, and a guess of each, from a thousandth of tanh(psi) to a thousand times as much.
struct ManyTrains {
  std::vector<State> states;
  std::vector<double> spacing, momentum, guess;
};
ManyTrains many_trains() {
  ManyTrains all;
  for (const double psi : {1e-280, 1e-100, 1e-15, 1e-6, 1e-3, 0.02, 0.1, 0.3, 0.6, 1.0, 1.4})
    for (const double phi : {-5.0, -1.0, -0.1, -1e-9, 0.0, 1e-5, 0.3, 2.0})
      for (double off = -3; off <= 3; off += 0.07) {
        const modulation::LagrangianState l = modulation::lagrangian_state({phi, psi});
        all.states.push_back({phi, psi});
        all.spacing.push_back(l.spacing);
        all.momentum.push_back(l.momentum);
        all.guess.push_back(std::tanh(psi) * std::pow(10, off));
      }
  return all;
}

/// A solution that is accepted is right to rounding, however bad its guess. Good guesses are accepted.
TEST(SolveStates, AcceptsOnlySolutions) {
  const ManyTrains t = many_trains();
  const std::size_t n = t.states.size();
  std::vector<double> s = t.guess, phi(n), psi(n), sound(n), EK(n), U(n), solved(n);
  modulation::solve_states({n, t.spacing.data(), t.momentum.data(), s.data(), phi.data(), psi.data(), sound.data(),
                            EK.data(), U.data(), solved.data()});
  int accepted = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const State& state = t.states[i];
    const bool is_good = std::fabs(std::log(t.guess[i] / std::tanh(state.psi))) < 0.03 && state.psi < 0.2;
    EXPECT_TRUE(solved[i] == 1 || !is_good) << state.phi << ", " << state.psi << " from " << t.guess[i];
    if (solved[i] == 0) {
      EXPECT_EQ(s[i], t.guess[i]);  // for the scalar code
      continue;
    }
    ++accepted;
    const elliptic::AtPsi at = elliptic::at_psi(state.psi);
    // The rounding of the spacing 2 ln(4 / psi) / cosh(phi) changes ln psi by eps ln(4 / psi).
    const double rounding = 1e-15 * (1 + std::fabs(std::log(4 / state.psi))) * (1 + std::fabs(state.phi));
    EXPECT_NEAR(psi[i] / state.psi, 1, 8 * rounding) << state.phi << ", " << state.psi << " from " << t.guess[i];
    EXPECT_NEAR(phi[i], state.phi, 8 * rounding * std::fabs(state.phi)) << state.phi << ", " << state.psi;
    EXPECT_NEAR(s[i] / std::tanh(state.psi), 1, 8 * rounding);
    EXPECT_NEAR(U[i], std::tanh(state.phi), 8 * rounding * std::fabs(std::tanh(state.phi)));
    EXPECT_NEAR(EK[i] / (at.E * at.K), 1, 8 * rounding);
    EXPECT_NEAR(sound[i] / (std::tanh(state.psi) * at.K / at.E), 1, 8 * rounding);
  }
  EXPECT_GT(accepted, static_cast<int>(n) / 5);
}

/// The largest slip velocity of a train in local units is 2 sinh |phi| cosh psi.
TEST(SolveStates, FindsTheFastestSlip) {
  const ManyTrains t = many_trains();
  const std::size_t n = t.states.size();
  std::vector<double> s = t.guess, phi(n), psi(n), K(n), E(n), U(n), solved(n), fastest(n);
  modulation::solve_slip({n, t.spacing.data(), t.momentum.data(), s.data(), phi.data(), psi.data(), K.data(), E.data(),
                          U.data(), solved.data()},
                         fastest.data());
  for (std::size_t i = 0; i < n; ++i) {
    if (solved[i] == 0) continue;
    const State& state = t.states[i];
    const double rounding = 1e-14 * (1 + std::fabs(std::log(4 / state.psi))) * (1 + std::fabs(state.phi));
    const double exact = 2 * std::sinh(std::fabs(state.phi)) * std::cosh(state.psi), speed = std::tanh(state.phi);
    EXPECT_NEAR(fastest[i], exact, rounding * exact);
    EXPECT_NEAR(U[i], speed, rounding * std::fabs(speed));
  }
}

}  // namespace
