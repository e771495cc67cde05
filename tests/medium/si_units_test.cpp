#include "slipfront/theory/medium/si_units.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>

#include "slipfront/error.hpp"
#include "slipfront/theory/medium/medium.hpp"

namespace {

using slipfront::InputError;
using slipfront::medium::Constants;
using slipfront::medium::in_si;
using slipfront::medium::SiUnits;
using slipfront::medium::symbols_of;
using std::numbers::pi;

constexpr double rho = 2700, mu = 30e9, nu = 0.25, A = 0.01, b = 2e-3;
Constants interface(double contact_ratio) {
  Constants constants;
  constants.contact_ratio = contact_ratio;
  constants.asperity_spacing = b;
  return constants;
}

Constants rock_constants() {
  Constants constants = interface(A);
  constants.shear_modulus = mu;
  constants.density = rho;
  constants.poisson_ratio = nu;
  return constants;
}

TEST(SiUnits, AgreeWithTheUnitsOfTheModel) {
  const SiUnits units(rock_constants());
  const double c = std::sqrt(2 * mu / (rho * (1 - nu)));
  const auto model = slipfront::medium::units(mu, c, A, b);
  EXPECT_DOUBLE_EQ(units.of("b / A").value, model.length);
  EXPECT_DOUBLE_EQ(units.of("b / (c A)").value, model.time);
  EXPECT_DOUBLE_EQ(units.of("mu A / pi").value, model.stress);
  EXPECT_DOUBLE_EQ(units.of("c A / pi").value, model.slip_velocity);
  EXPECT_DOUBLE_EQ(units.of("c").value, model.velocity);
  EXPECT_DOUBLE_EQ(units.of("mu A^2 / (pi (1 - nu))").value, slipfront::medium::traction_unit(mu, nu, A));
  EXPECT_TRUE(units.assumed().empty());
}

TEST(SiUnits, SlipIsTheIntegralOfTheSlipVelocity) {
  const SiUnits units(rock_constants());
  const auto slip = units.of("b / (2 pi)");
  EXPECT_DOUBLE_EQ(slip.value, units.of("c A / pi").value * units.of("b / (c A)").value);
  EXPECT_TRUE(slip.between_faces);
  EXPECT_DOUBLE_EQ(units.of("b^2 / (2 pi A)").value, slip.value * units.of("b / A").value);
}

/// In each description an energy is the work of a force along a slip.
TEST(SiUnits, EnergyIsForceTimesSlip) {
  const SiUnits units(rock_constants());
  const double work = units.of("mu A^2 / (pi (1 - nu))").value * units.of("b / (2 pi)").value;
  EXPECT_DOUBLE_EQ(units.of("mu A^2 b / (2 pi^2 (1 - nu))").value, work);
  EXPECT_DOUBLE_EQ(units.of("mu b^2 A / (2 pi^2 (1 - nu))").value, work * units.of("b / A").value);
}

TEST(SiUnits, HaveTheNamesOfUdunits) {
  const SiUnits units(rock_constants());
  EXPECT_EQ(units.of("A / b").name, "m-1");
  EXPECT_EQ(units.of("c A / pi").name, "m s-1");
  EXPECT_EQ(units.of("mu A^2 b / (2 pi^2 (1 - nu))").name, "J m-2");
  EXPECT_EQ(units.of("mu b^2 A / (2 pi^2 (1 - nu))").name, "J m-1");
  EXPECT_EQ(units.of("").name, "1");
  EXPECT_EQ(symbols_of("mu A^2 / (pi (1 - nu))"), "mu A nu");
}

TEST(SiUnits, RejectTextsThatAreNoUnits) {
  for (const std::string text : {"km", "mu + b", "(mu + b)", "A^A", "A^99", "mu(A)(", "mu.real", "", "1e9", "A^"})
    EXPECT_THROW(in_si(text, {mu, nu, A, b, 1}), InputError) << text;
}

TEST(SiUnits, NameTheConstantsThatAreMissing) {
  try {
    const SiUnits units(Constants{});
    FAIL();
  } catch (const InputError& error) {
    EXPECT_EQ(error.complaint().problem, "results in SI units need medium.contact_ratio and medium.asperity_spacing");
  }
  EXPECT_NE(SiUnits(interface(A)).assumed().find("shear_modulus"), std::string::npos);
  EXPECT_THROW(SiUnits(interface(2)), InputError);
}

}  // namespace
