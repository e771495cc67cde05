#include "slipfront/theory/medium/medium.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "slipfront/error.hpp"

namespace {

using namespace slipfront;
using std::numbers::pi;

const medium::Interface rock{
    .shear_modulus = 30e9, .density = 2700, .poisson_ratio = 0.25, .asperity_spacing = 1e-3, .contact_ratio = 0.01};

const medium::Interface soft{
    .shear_modulus = 30e9, .density = 2700, .poisson_ratio = 0.3, .asperity_spacing = 1e-3, .contact_ratio = 0.05};

TEST(Medium, HasTheSpeedOfThePaper) {  // the paper's example of Parkfield (docs/worked_examples.md)
  EXPECT_NEAR(medium::speed_from_p_wave(6000, 0.3), 5421.0, 0.05);
}

TEST(Medium, FindsOneSpeedFromAnyConstants) {
  const double vs = std::sqrt(rock.shear_modulus / rock.density);
  const double vp = vs * std::sqrt(2 * (1 - 0.25) / (1 - 2 * 0.25));
  const double c = medium::speed_from_shear_modulus(rock.shear_modulus, rock.density, 0.25);
  EXPECT_NEAR(medium::speed_from_s_wave(vs, 0.25), c, 1e-12 * c);
  EXPECT_NEAR(medium::speed_from_p_wave(vp, 0.25), c, 1e-12 * c);
  EXPECT_NEAR(medium::chain_constants(rock).speed, c, 1e-12 * c);
  EXPECT_NEAR(medium::poisson_ratio(vp, vs), 0.25, 1e-14);
}

TEST(Medium, FindsTheConstantsOfEquation1) {
  const medium::ChainConstants chain = medium::chain_constants(rock);
  EXPECT_DOUBLE_EQ(chain.mass, 2.7e-6);
  EXPECT_DOUBLE_EQ(chain.spring, 8e7);
  EXPECT_NEAR(chain.substrate_force, 30e9 * 1e-6 / (2 * pi) * 1e-4 / 0.375, 1e-9);
}

/// The units map Eq. (1) to Eq. (3): every term of Eq. (1) has the same unit of force, and the lattice spacing is A.
/// This requires F_d = K_b b A^2 / (2 pi) with the derived form of A_plastic. The paper's mu b^2 (A / A_plastic)^2 / 2
/// pi is equal to that.
TEST(Medium, HasUnitsThatTurnEquation1IntoEquation3) {
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
  EXPECT_EQ(u.velocity, chain.speed);
}

/// The terminal velocity, over c, of one dislocation on the lattice of Eq. (1) in SI units. A traction (Pa) on the
/// nominal area pushes it against a drag (N s/m) on each asperity. We use leapfrog steps and free ends.
double pushed_dislocation(double traction, double drag) {
  const medium::ChainConstants chain = medium::chain_constants(soft);
  const double b = soft.asperity_spacing, width = b / soft.contact_ratio;  // b / A
  const double dt = 0.02 * width / chain.speed, push = traction * b * b;
  const double tilt = b / (2 * pi) * std::asin(push / chain.substrate_force);
  constexpr std::size_t sites = 1200, middle = 400;
  constexpr int steps = 4000;
  std::vector<double> now(sites), before(sites), next(sites);
  for (std::size_t i = 0; i < sites; ++i)
    before[i] = now[i] = tilt + b / (2 * pi) * 4 * std::atan(std::exp((double(middle) - double(i)) * b / width));
  const auto position = [&] {  // x at which the slip is half a spacing
    std::size_t i = 0;
    while (now[i] > tilt + b / 2) ++i;
    return b * (double(i) - (tilt + b / 2 - now[i]) / (now[i - 1] - now[i]));
  };
  double halfway = 0;
  for (int n = 0; n < steps; ++n) {
    if (n == steps / 2) halfway = position();
    for (std::size_t i = 0; i < sites; ++i) {
      const double bonds = (i > 0 ? now[i - 1] - now[i] : 0) + (i + 1 < sites ? now[i + 1] - now[i] : 0);
      const double force = chain.spring * bonds - chain.substrate_force * std::sin(2 * pi * now[i] / b) + push;
      const double share = drag * dt / (2 * chain.mass);
      next[i] = (2 * now[i] - (1 - share) * before[i] + dt * dt / chain.mass * force) / (1 + share);
    }
    before.swap(now), now.swap(next);
  }
  return (position() - halfway) / (steps / 2 * dt) / chain.speed;
}

/// Checks the unit of F in another way. The lattice in SI units follows only from Eq. (1), and the textbook result for
/// one dislocation (McLaughlin & Scott 1978) is given in F and C. With mu A / (2 pi) as the unit, F would be 7 times
/// too small.
TEST(Medium, HasATractionUnitThatMovesADislocation) {
  const medium::ChainConstants chain = medium::chain_constants(soft);
  const double unit = medium::traction_unit(soft.shear_modulus, soft.poisson_ratio, soft.contact_ratio);
  EXPECT_NEAR(unit * soft.asperity_spacing * soft.asperity_spacing / chain.substrate_force, 1, 1e-14);
  EXPECT_NEAR(medium::printed_traction_unit(soft.shear_modulus, soft.contact_ratio) / unit, 0.7 / (2 * 0.05), 1e-13);
  for (const double F : {0.04, 0.08}) {
    const double C = 0.2, drag = C * chain.substrate_force / (chain.speed * soft.contact_ratio / (2 * pi));
    const double U = 1 / std::sqrt(1 + std::pow(4 * C / (pi * F), 2));
    EXPECT_NEAR(pushed_dislocation(F * unit, drag) / U, 1, 0.01) << F;
  }
  EXPECT_NEAR(medium::printed_traction_unit(30e9, 0.003) / medium::traction_unit(30e9, 0.3, 0.003), 116.7, 0.05);
}

TEST(Medium, FindsBothFormsOfTheContactRatio) {
  const double plastic = medium::plastic_contact_ratio(0.3);
  EXPECT_NEAR(plastic, std::sqrt(0.35), 1e-15);
  EXPECT_NEAR(medium::contact_ratio(100e6, 10e9, 0.3, medium::ContactForm::derived), 0.01 * plastic, 1e-16);
  EXPECT_NEAR(medium::contact_ratio(100e6, 10e9, 0.3, medium::ContactForm::rounded), 0.01, 1e-16);
}

TEST(Medium, RejectsConstantsOutOfRange) {
  for (const double nu : {-1.0, 0.5, 0.7, std::nan("")})
    EXPECT_THROW(medium::speed_from_p_wave(6000, nu), InputError) << nu;
  EXPECT_THROW(medium::speed_from_p_wave(-6000, 0.3), InputError);
  EXPECT_THROW(medium::poisson_ratio(1, 1), InputError);
  EXPECT_THROW(medium::units(30e9, 5000, 0, 1e-3), InputError);
  EXPECT_THROW(medium::traction_unit(30e9, 0.5, 0.01), InputError);
  EXPECT_THROW(medium::printed_traction_unit(30e9, 0), InputError);
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
