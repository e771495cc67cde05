#include "slipfront/theory/modulation/modulation.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "error_metric.hpp"
#include "reference_table.hpp"

namespace {

using namespace slipfront;

TEST(Sound, MatchesTheTable) {
  for (const auto& row : reference_table("psi.csv")) {
    const modulation::Sound c = modulation::sound(row["psi"]);
    EXPECT_LE(error_in_eps(c.c0, row["c0"]), 6) << "psi = " << row.text("psi");
    EXPECT_LE(error_in_eps(c.one_minus, row["one_minus_c0"]), 8) << "psi = " << row.text("psi");
    EXPECT_LE(error_in_eps(c.rapidity, row["sound_rapidity"]), 8) << "psi = " << row.text("psi");
  }
}

TEST(Sound, SlopesAreDerivatives) {
  for (const double psi : {1e-8, 1e-3, 0.05, 0.12, 0.13, 0.4, 0.9, 2.0, 6.0, 19.0, 30.0}) {
    const double h = 1e-3 * std::fmin(psi, 1.0);
    const auto rapidity = [&](int i) { return modulation::sound(psi + i * h).rapidity; };
    const auto log_c0 = [&](int i) { return std::log(modulation::sound(psi + i * h).c0); };
    const auto slope = [&](auto&& f) { return (-f(2) + 8 * f(1) - 8 * f(-1) + f(-2)) / (12 * h); };
    EXPECT_NEAR(modulation::sound(psi).slope / slope(rapidity), 1, 1e-9) << psi;
    if (psi < 1) {
      EXPECT_NEAR(modulation::sound(psi).log_slope / slope(log_c0), 1, 1e-9) << psi;
    }
  }
}

/// Along each characteristic direction d(flux) = lambda d(density), so the diagonal form agrees with the conservation
/// laws.
TEST(Characteristics, AreEigenvaluesOfTheFluxes) {
  for (const State s : {State{0.0, 0.3}, State{0.5, 1e-4}, State{-1.0, 0.8}, State{0.2, 2.5}, State{2.0, 1e-9}}) {
    const modulation::Speeds lambda = modulation::characteristic_speeds(s);
    for (const int sign : {-1, 1}) {
      // The invariant phi -+ psi is constant along the direction that moves with lambda_pm.
      const auto at = [&](double d) { return State{s.phi + sign * d, s.psi + d}; };
      const double h = 1e-4 * s.psi;
      const auto change = [&](auto&& quantity, auto member) {
        const auto f = [&](int i) { return quantity(at(i * h)).*member; };
        return (-f(2) + 8 * f(1) - 8 * f(-1) + f(-2)) / (12 * h);
      };
      const double speed = sign < 0 ? lambda.minus : lambda.plus;
      for (const auto member : {&modulation::Pair::number, &modulation::Pair::momentum}) {
        const double df = change(modulation::flux, member), dd = change(modulation::density, member);
        EXPECT_NEAR(df, speed * dd, 1e-8 * (std::fabs(df) + std::fabs(dd))) << s.phi << " " << s.psi << " " << sign;
      }
    }
  }
}

TEST(Characteristics, MoveWithTheEmptyState) {
  const modulation::Speeds edge = modulation::characteristic_speeds({0.4, 0});
  EXPECT_EQ(edge.minus, std::tanh(0.4));
  EXPECT_EQ(edge.plus, std::tanh(0.4));
  EXPECT_EQ(modulation::riemann_invariants({0.4, 0.1}).plus, 0.5);
}

}  // namespace
