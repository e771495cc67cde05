#include "slipfront/medium/medium.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "slipfront/error.hpp"

namespace {

using namespace slipfront;
using std::numbers::pi;

const medium::Interface rock{
    .shear_modulus = 30e9, .density = 2700, .poisson_ratio = 0.25, .asperity_spacing = 1e-3, .contact_ratio = 0.01};

TEST(Medium, SpeedOfThePaper) {  // docs/theory.md 5: 6 km/s and 0.3 give 5.4210 km/s
  EXPECT_NEAR(medium::speed_from_p_wave(6000, 0.3), 5421.0, 0.05);
}

TEST(Medium, SpeedIsTheSameFromAnyConstants) {
  const double vs = std::sqrt(rock.shear_modulus / rock.density);
  const double vp = vs * std::sqrt(2 * (1 - 0.25) / (1 - 2 * 0.25));
  const double c = medium::speed_from_shear_modulus(rock.shear_modulus, rock.density, 0.25);
  EXPECT_NEAR(medium::speed_from_s_wave(vs, 0.25), c, 1e-12 * c);
  EXPECT_NEAR(medium::speed_from_p_wave(vp, 0.25), c, 1e-12 * c);
  EXPECT_NEAR(medium::chain_constants(rock).speed, c, 1e-12 * c);
  EXPECT_NEAR(medium::poisson_ratio(vp, vs), 0.25, 1e-14);
}

TEST(Medium, ChainConstantsOfEquation1) {
  const medium::ChainConstants chain = medium::chain_constants(rock);
  EXPECT_DOUBLE_EQ(chain.mass, 2.7e-6);
  EXPECT_DOUBLE_EQ(chain.spring, 8e7);
  EXPECT_NEAR(chain.substrate_force, 30e9 * 1e-6 / (2 * pi) * 1e-4 / 0.375, 1e-9);
}

/// The map to Eq. (3): with these units every term of Eq. (1) is measured by the same force, and the lattice spacing is
/// A. That fixes F_d = K_b b A^2 / (2 pi) at the derived form of A_plastic, which is where the paper's mu b^2 (A /
/// A_plastic)^2 / 2 pi comes from.
TEST(Medium, UnitsTurnEquation1IntoEquation3) {
  const medium::ChainConstants chain = medium::chain_constants(rock);
  const medium::Units u = medium::units(rock.shear_modulus, chain.speed, rock.contact_ratio, rock.asperity_spacing);
  const double inertia = chain.mass * u.slip / (u.time * u.time);
  const double tension = chain.spring * u.slip * std::pow(rock.asperity_spacing / u.length, 2);
  EXPECT_NEAR(inertia / chain.substrate_force, 1, 1e-12);
  EXPECT_NEAR(tension / chain.substrate_force, 1, 1e-12);
  EXPECT_NEAR(rock.asperity_spacing / u.length, rock.contact_ratio, 1e-15);
  EXPECT_NEAR(u.length / u.time, chain.speed, 1e-9);
  EXPECT_NEAR(u.stress, 2 * rock.shear_modulus * u.strain, 1e-3);              // sigma = 2 mu strain
  EXPECT_NEAR(u.strain, u.slip / u.length, 1e-18);                             // strain = u_x
  EXPECT_NEAR(u.slip_velocity, medium::face_factor * u.slip / u.time, 1e-12);  // both faces move
  EXPECT_NEAR(u.force, u.stress / 2, 1e-6);
  EXPECT_EQ(u.velocity, chain.speed);
}

TEST(Medium, BothFormsOfTheContactRatio) {
  const double plastic = medium::plastic_contact_ratio(0.3);
  EXPECT_NEAR(plastic, std::sqrt(0.35), 1e-15);
  EXPECT_NEAR(medium::contact_ratio(100e6, 10e9, 0.3, medium::ContactForm::derived), 0.01 * plastic, 1e-16);
  EXPECT_NEAR(medium::contact_ratio(100e6, 10e9, 0.3, medium::ContactForm::rounded), 0.01, 1e-16);
}

TEST(Medium, RefusesConstantsOutOfRange) {
  for (const double nu : {-1.0, 0.5, 0.7, std::nan("")})
    EXPECT_THROW(medium::speed_from_p_wave(6000, nu), InputError) << nu;
  EXPECT_THROW(medium::speed_from_p_wave(-6000, 0.3), InputError);
  EXPECT_THROW(medium::poisson_ratio(1, 1), InputError);
  EXPECT_THROW(medium::units(30e9, 5000, 0, 1e-3), InputError);
  medium::Interface bad = rock;
  bad.density = 0;
  try {
    medium::chain_constants(bad);
    FAIL();
  } catch (const InputError& error) {
    EXPECT_EQ(error.complaint().key, "density");
  }
}

}  // namespace
