#include "slipfront/modulation/friction.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>

#include "error_metric.hpp"
#include "slipfront/elliptic/complete.hpp"
#include "slipfront/error.hpp"
#include "slipfront/modulation/characteristics.hpp"
#include "slipfront/modulation/per_dislocation.hpp"
#include "slipfront/train/train.hpp"

namespace {

using namespace slipfront;
using namespace slipfront::modulation;

RC_GTEST_PROP(PerDislocation, RoundTrips, ()) {
  const double psi = std::pow(10.0, *rc::gen::inRange(-299000, 699) / 1000.0);
  const double relative = *rc::gen::inRange(-3000, 3000) / 1000.0;
  const double phi = *rc::gen::arbitrary<bool>() ? relative * std::fmin(psi, 1.0) : relative * 6;
  const State back = state_of(lagrangian_state({phi, psi}), psi * (1 + *rc::gen::inRange(-900, 900) / 1000.0));
  // A spacing of 2 ln(4 / psi) carries eps ln(4 / psi) in ln psi; a momentum of size cosh phi hides psi behind phi.
  const double condition = (1 + std::fabs(std::log(4 / psi))) * (1 + std::fabs(phi));
  RC_ASSERT(error_in_eps(back.psi, psi) <= 32 * condition);
  RC_ASSERT(std::fabs(back.phi - phi) <= DBL_EPSILON * 32 * (std::fabs(phi) + 1e-300) * (1 + condition * psi * psi));
}

/// Both routes of the solve, and what else it finds, against the direct functions.
TEST(PerDislocation, FindsSoundAndClosureToo) {
  for (const double psi : {1e-295, 1e-20, 1e-3, 0.124, 0.126, 0.5, 1.4, 1.5, 3.0, 30.0})
    for (const double off : {0.5, 0.99, 1.01, 3.0}) {
      const State s{0.3, psi};
      const Resolved r = resolve(lagrangian_state(s), psi * off);
      const double condition = 1 + std::fabs(std::log(4 / psi));
      EXPECT_LE(error_in_eps(r.sound_speed, sound(r.state.psi).c0), 32) << psi;
      const elliptic::AtPsi at = elliptic::at_psi(r.state.psi);
      EXPECT_LE(error_in_eps(r.EK, at.E * at.K), 32) << psi;
      EXPECT_LE(error_in_eps(r.state.psi, psi), 32 * condition) << psi;
    }
}

TEST(PerDislocation, ConvergesFromAnyStart) {
  for (const double psi : {1e-300, 2e-174, 1e-9, 0.3, 5.0, 40.0})
    for (const double guess : {1e-300, 1e-175, 1e-5, 0.5, 3.0, 50.0, 600.0, 0.0})
      EXPECT_NEAR(state_of(lagrangian_state({0.1, psi}), guess).psi / psi, 1, 1e-11) << psi << " from " << guess;
}

TEST(PerDislocation, GoesToTheEmptyStateAndRefusesNonsense) {
  EXPECT_TRUE(state_of({2000, 0.1}, 1).empty());
  EXPECT_NEAR(state_of({2000, 8 * std::sinh(0.3)}, 1).phi, 0.3, 1e-15);
  EXPECT_THROW(state_of({-1, 0}, 1), NumericsError);
  EXPECT_THROW(state_of({std::nan(""), 0}, 1), NumericsError);
}

/// <f(w) sigma> and <f(w)> by quadrature of the fields themselves.
TEST(Friction, IsTheAverageOfTheFields) {
  const State states[] = {{0.3, 0.2}, {-0.7, 0.9}, {1.1, 0.02}, {0.05, 2.5}};
  for (const State& s : states)
    for (const double n : {0.5, 1.0, 2.0, 3.3}) {
      const double length = train::spacing(s);
      constexpr int points = 4000;
      double f_sigma = 0, f = 0, k = 0;
      for (int i = 0; i < points; ++i) {
        const train::Fields at = train::fields(s, length * i / points);
        const double force = 0.7 * std::copysign(std::pow(std::fabs(at.w), n), at.w);
        f_sigma += force * at.sigma / points;
        f += force / points;
        k += at.sigma / points;
      }
      const FrictionLaw law = n == 1 ? FrictionLaw::viscous : FrictionLaw::power;
      EXPECT_NEAR(momentum_loss(s, {law, 0.7, n, Closure::consistent}) / f_sigma, 1, 1e-10) << n << " " << s.psi;
      EXPECT_NEAR(momentum_loss(s, {law, 0.7, n, Closure::paper}) / (k * f), 1, 1e-10) << n << " " << s.psi;
      EXPECT_NEAR(momentum_loss(s, {FrictionLaw::coulomb, 0.7}), std::copysign(0.7 * k, s.phi), 1e-10 * k);
    }
}

TEST(Friction, PowersOneAndTwoAreTheClosedForms) {
  for (const double psi : {1e-200, 1e-9, 0.01, 0.5, 4.0}) {
    const State s{0.4, psi};
    for (const Closure closure : {Closure::consistent, Closure::paper}) {
      const double viscous = momentum_loss(s, {FrictionLaw::viscous, 1, 1, closure});
      EXPECT_NEAR(momentum_loss(s, {FrictionLaw::power, 1, 1, closure}) / viscous, 1, 1e-13) << psi;
    }
    const train::Averages a = train::averages(s);
    const double U = std::tanh(0.4);
    EXPECT_NEAR(momentum_loss(s, {FrictionLaw::power, 1, 2, Closure::consistent}) / (U * U * a.sigma3), 1, 1e-13)
        << psi;
  }
}

TEST(Friction, OpposesAndVanishesAtRest) {
  for (const FrictionLaw law : {FrictionLaw::viscous, FrictionLaw::coulomb, FrictionLaw::power}) {
    EXPECT_EQ(momentum_loss({0, 0.3}, {law, 2, 2}), 0);
    EXPECT_EQ(momentum_loss({1, 0}, {law, 2, 2}), 0);
    EXPECT_EQ(momentum_loss({-0.3, 0.3}, {law, 2, 2}), -momentum_loss({0.3, 0.3}, {law, 2, 2}));
  }
}

/// docs/theory.md 3.3: the ratio of the closures, I / W = 4 E K / pi^2.
TEST(Friction, PaperClosureUnderstates) {
  const State s{0.2, 1e-3};
  const train::Averages a = train::averages(s);
  EXPECT_NEAR(momentum_loss(s, {FrictionLaw::viscous, 1, 1, Closure::consistent}) /
                  momentum_loss(s, {FrictionLaw::viscous, 1, 1, Closure::paper}),
              a.I / a.W, 1e-14);
}

TEST(PowerLawRate, IsTheRelaxationRate) {
  for (const double n : {0.3, 0.7, 1.0, 1.5, 2.0, 5.0})
    for (const Closure closure : {Closure::consistent, Closure::paper}) {
      const Friction friction{FrictionLaw::power, 0.7, n, closure};
      const PowerLawRate rate(friction);
      for (const double psi : {1e-250, 1e-20, 1e-6, 1e-3, 0.011, 0.3, 0.97, 1.7, 4.3, 12.0, 25.0})
        for (const double phi : {-2.0, 1e-3, 0.4}) {
          const double want = relaxation_rate({phi, psi}, friction);
          EXPECT_NEAR(rate({phi, psi}) / want, 1, 1e-9) << n << " " << psi << " " << phi;
        }
    }
}

}  // namespace
