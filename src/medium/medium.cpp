#include "slipfront/medium/medium.hpp"

#include <cmath>
#include <numbers>
#include <string>

#include "foundation/text/digits.hpp"
#include "slipfront/error.hpp"

namespace slipfront::medium {
namespace {

using std::numbers::pi;

double positive(double value, const char* key) {
  if (value > 0 && std::isfinite(value)) return value;
  throw InputError({.key = key, .value = digits(value), .problem = "not a positive number", .allowed = "> 0, finite"});
}

double checked_poisson(double nu) {
  if (nu > -1 && nu < 0.5) return nu;
  throw InputError(
      {.key = "poisson_ratio", .value = digits(nu), .problem = "out of range", .allowed = "-1 < poisson_ratio < 0.5"});
}

double checked_contact(double A) {
  if (A > 0 && A <= 1) return A;
  throw InputError(
      {.key = "contact_ratio", .value = digits(A), .problem = "out of range", .allowed = "0 < contact_ratio <= 1"});
}

}  // namespace

double plastic_contact_ratio(double poisson_ratio) { return std::sqrt((1 - checked_poisson(poisson_ratio)) / 2); }

double contact_ratio(double normal_stress, double hardness, double poisson_ratio, ContactForm form) {
  const double pressed = positive(normal_stress, "normal_stress") / positive(hardness, "hardness");
  const double plastic = plastic_contact_ratio(poisson_ratio);
  return form == ContactForm::derived ? plastic * pressed : pressed;
}

ChainConstants chain_constants(const Interface& i) {
  const double mu = positive(i.shear_modulus, "shear_modulus"), b = positive(i.asperity_spacing, "asperity_spacing");
  const double pressed = checked_contact(i.contact_ratio) / plastic_contact_ratio(i.poisson_ratio);
  const double mass = positive(i.density, "density") * b * b * b;
  const double spring = 2 * mu * b / (1 - i.poisson_ratio);
  return {mass, spring, mu * b * b / (2 * pi) * pressed * pressed, b * std::sqrt(spring / mass)};
}

double speed_from_shear_modulus(double shear_modulus, double density, double poisson_ratio) {
  return std::sqrt(2 * positive(shear_modulus, "shear_modulus") /
                   (positive(density, "density") * (1 - checked_poisson(poisson_ratio))));
}

double speed_from_p_wave(double p_wave_speed, double poisson_ratio) {
  const double nu = checked_poisson(poisson_ratio);
  return positive(p_wave_speed, "p_wave_speed") * std::sqrt(1 - 2 * nu) / (1 - nu);
}

double speed_from_s_wave(double s_wave_speed, double poisson_ratio) {
  return positive(s_wave_speed, "s_wave_speed") * std::sqrt(2 / (1 - checked_poisson(poisson_ratio)));
}

double poisson_ratio(double p_wave_speed, double s_wave_speed) {
  const double ratio = positive(p_wave_speed, "p_wave_speed") / positive(s_wave_speed, "s_wave_speed");
  const double square = ratio * ratio;
  if (!(square > 4.0 / 3.0))
    throw InputError({.key = "p_wave_speed",
                      .value = digits(p_wave_speed),
                      .problem = "too slow for an s_wave_speed of " + digits(s_wave_speed),
                      .allowed = "above 2 / sqrt(3) times the s_wave_speed"});
  return (square - 2) / (2 * (square - 1));
}

Units units(double shear_modulus, double speed, double contact_ratio, double asperity_spacing) {
  const double mu = positive(shear_modulus, "shear_modulus"), c = positive(speed, "speed"),
               A = checked_contact(contact_ratio);
  const double b = positive(asperity_spacing, "asperity_spacing");
  return {.slip = b / (2 * pi),
          .length = b / A,
          .time = b / (c * A),
          .strain = A / (2 * pi),
          .stress = stress_unit(mu, A),
          .slip_velocity = slip_velocity_unit(c, A),
          .velocity = c};
}

double traction_unit(double shear_modulus, double poisson_ratio, double contact_ratio) {
  const double A = checked_contact(contact_ratio);
  // Eq. (2): A^2 sin u = (F - f) 2 pi / (b K_b), so the unit of F is A^2 b K_b / (2 pi), per area b^2.
  return positive(shear_modulus, "shear_modulus") * A * A / (pi * (1 - checked_poisson(poisson_ratio)));
}

double printed_traction_unit(double shear_modulus, double contact_ratio) {
  return positive(shear_modulus, "shear_modulus") * checked_contact(contact_ratio) / (2 * pi);
}

double stress_unit(double shear_modulus, double contact_ratio) { return shear_modulus * contact_ratio / pi; }

double slip_velocity_unit(double speed, double contact_ratio) { return face_factor * speed * contact_ratio / (2 * pi); }

}  // namespace slipfront::medium
