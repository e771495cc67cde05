#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>

#include "error_metric.hpp"
#include "slipfront/error.hpp"
#include "slipfront/math/elliptic.hpp"
#include "slipfront/theory/modulation/modulation.hpp"
#include "slipfront/theory/train.hpp"

namespace {

using namespace slipfront;
using namespace slipfront::modulation;

RC_GTEST_PROP(PerDislocation, RoundTrips, ()) {
  const double psi = std::pow(10.0, *rc::gen::inRange(-299000, 699) / 1000.0);
  const double relative = *rc::gen::inRange(-3000, 3000) / 1000.0;
  const double phi = *rc::gen::arbitrary<bool>() ? relative * std::fmin(psi, 1.0) : relative * 6;
  const State back = state_of(lagrangian_state({phi, psi}), psi * (1 + *rc::gen::inRange(-900, 900) / 1000.0));
  // The rounding of the spacing 2 ln(4 / psi) changes ln psi by eps ln(4 / psi). A large momentum, of the order of
  // cosh phi, makes psi less certain still.
  const double condition = (1 + std::fabs(std::log(4 / psi))) * (1 + std::fabs(phi));
  RC_ASSERT(error_in_eps(back.psi, psi) <= 32 * condition);
  RC_ASSERT(std::fabs(back.phi - phi) <= DBL_EPSILON * 32 * (std::fabs(phi) + 1e-300) * (1 + condition * psi * psi));
}

/// Compares the state, the sound speed and E K, from both methods of the solver, with the direct functions.
TEST(PerDislocation, FindsSoundAndClosureWithTheState) {
  for (const double psi : {1e-295, 1e-20, 1e-3, 0.124, 0.126, 0.5, 1.4, 1.5, 3.0, 30.0})
    for (const double off : {0.5, 0.99, 1.01, 3.0}) {
      const State s{0.3, psi};
      const SolvedState r = solve_state(lagrangian_state(s), psi * off);
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

/// If dislocations are fast and far apart, K minus the length is not monotone. Newton's method once oscillated between
/// two states.
TEST(PerDislocation, ConvergesFromAnyStartIfDislocationsAreFastAndFarApart) {
  for (const double spacing : {500.0, 800.0, 1036.68, 1200.0})
    for (const double momentum : {-12.2072, 3.0, 50.0, 1000.0}) {
      const double spacing_at_rest = spacing * std::cosh(std::asinh(momentum / 8));
      for (double log_guess = -305; log_guess < 1.3; log_guess += 0.37) {
        const State found = state_of({spacing, momentum}, std::pow(10, log_guess));
        EXPECT_NEAR(found.phi / std::asinh(momentum / 8), 1, 1e-12);
        if (spacing_at_rest > 1420)
          EXPECT_EQ(found.psi, 0);
        else
          EXPECT_NEAR(std::log(found.psi) / (std::log(4) - spacing_at_rest / 2), 1, 1e-12);
      }
    }
}

TEST(PerDislocation, ReachesTheEmptyStateAndRejectsInvalidInput) {
  EXPECT_TRUE(state_of({2000, 0.1}, 1).empty());
  EXPECT_EQ(solve_state({2000, 0.1}, 1).sound_speed, 0);
  EXPECT_EQ(interaction_energy(0), 0);
  EXPECT_EQ(mass_excess(0), 0);
  EXPECT_NEAR(mass_excess(1) / mass_excess(1 + 1e-9), 1, 1e-8);
  EXPECT_NEAR(interaction_energy(1) / interaction_energy(1 + 1e-9), 1, 1e-8);
  EXPECT_NEAR(state_of({2000, 8 * std::sinh(0.3)}, 1).phi, 0.3, 1e-15);
  EXPECT_THROW(state_of({-1, 0}, 1), NumericsError);
  EXPECT_THROW(state_of({std::nan(""), 0}, 1), NumericsError);
}

/// Compares with the energy density of the averages, for states in which it is no small difference of large numbers.
TEST(PerDislocation, MatchesTheKineticEnergyOfTheAverages) {
  for (const double psi : {1e-5, 0.01, 0.3, 1.4, 3.0})
    for (const double phi : {0.03, 0.09, 0.11, 0.5, 2.0}) {
      const State moving{-phi, psi};
      const double spacing = lagrangian_state(moving).spacing;
      const State at_rest = state_of({spacing, 0}, psi);
      const double direct = (train::averages(moving).H - train::averages(at_rest).H) * spacing;
      EXPECT_NEAR(kinetic_energy(moving), direct, 1e-12 * train::averages(moving).H * spacing) << psi << " " << phi;
      EXPECT_NEAR(8 + interaction_energy(at_rest.psi), train::averages(at_rest).H * spacing,
                  1e-13 * train::averages(at_rest).H * spacing);
    }
}

/// The kinetic energy of a slow train is half of its momentum times its velocity. The differences of H lose all digits.
TEST(PerDislocation, KineticEnergyOfASlowTrainHasFullPrecision) {
  for (const double psi : {1e-300, 1e-17, 1e-4, 0.3, 3.0})
    for (const double phi : {1e-30, 1e-12, 1e-6}) {
      const State slow{phi, psi};
      EXPECT_NEAR(kinetic_energy(slow) / (lagrangian_state(slow).momentum * phi / 2), 1, 1e-10) << psi << " " << phi;
    }
  EXPECT_EQ(kinetic_energy({0, 0.3}), 0);
  EXPECT_NEAR(kinetic_energy({0.5, 0}), 8 * (std::cosh(0.5) - 1), 1e-14);
}

}  // namespace
