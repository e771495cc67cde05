#include "slipfront/theory/medium/medium.hpp"

#include <cmath>
#include <numbers>
#include <string>

#include "math/digits.hpp"
#include "slipfront/error.hpp"
#include "slipfront/text/quantity.hpp"
#include "slipfront/theory/medium/constants.hpp"

namespace slipfront::medium {

const std::vector<Constant>& constants() {
  static const std::vector<Constant> all = {
      {"shear_modulus", Dimension::pressure, "shear modulus mu of the rock", &Constants::shear_modulus},
      {"poisson_ratio", Dimension::ratio, "Poisson's ratio nu", &Constants::poisson_ratio},
      {"p_wave_speed", Dimension::velocity, "speed of P waves", &Constants::p_wave_speed},
      {"s_wave_speed", Dimension::velocity, "speed of S waves", &Constants::s_wave_speed},
      {"density", Dimension::density, "density rho of the rock", &Constants::density},
      {"contact_ratio", Dimension::ratio, "contact ratio A: real over nominal area of contact",
       &Constants::contact_ratio},
      {"asperity_spacing", Dimension::length, "asperity spacing b", &Constants::asperity_spacing},
  };
  return all;
}

Elastic elastic(const Constants& o, const Defaults& d, std::string* assumed) {
  const auto assume = [&](double value, const char* key, const char* unit, bool stated) {
    if (!stated && assumed) *assumed += (assumed->empty() ? "" : ", ") + (key + (" " + digits(value)) + unit);
    return value;
  };
  Elastic e{};
  const bool both_speeds = o.p_wave_speed && o.s_wave_speed;
  e.poisson_ratio = o.poisson_ratio ? *o.poisson_ratio
                    : both_speeds   ? poisson_ratio(*o.p_wave_speed, *o.s_wave_speed)
                                    : assume(d.poisson_ratio, "poisson_ratio", "", d.stated_poisson);
  const bool by_modulus = o.shear_modulus && o.density;
  e.speed = o.p_wave_speed   ? speed_from_p_wave(*o.p_wave_speed, e.poisson_ratio)
            : o.s_wave_speed ? speed_from_s_wave(*o.s_wave_speed, e.poisson_ratio)
            : by_modulus
                ? speed_from_shear_modulus(*o.shear_modulus, *o.density, e.poisson_ratio)
                : speed_from_p_wave(assume(d.p_wave_speed, "p_wave_speed", " m/s", d.stated_speed), e.poisson_ratio);
  e.shear_modulus = o.shear_modulus               ? *o.shear_modulus
                    : o.s_wave_speed && o.density ? *o.density * *o.s_wave_speed * *o.s_wave_speed
                                                  : assume(d.shear_modulus, "shear_modulus", " Pa", d.stated_modulus);
  return e;
}

namespace {

/// Reads one stated constant, if it was stated. \throws InputError that names the option.
void read_stated(const std::string& text, const char* option, Dimension dimension, double& value, bool& is_stated) {
  if (text.empty()) return;
  try {
    const auto span = parse_quantity(text, dimension);
    if (span.low < span.high)
      throw InputError({.value = text,
                        .problem = "a range, where one number is needed",
                        .allowed = std::string(example(dimension))});
    const bool is_ratio = dimension == Dimension::ratio;
    if (is_ratio ? !(span.low > -1 && span.low < 0.5) : !(span.low > 0))
      throw InputError(
          {.value = text, .problem = "out of range", .allowed = is_ratio ? "-1 < poisson_ratio < 0.5" : "> 0"});
    value = span.low;
    is_stated = true;
  } catch (const InputError& error) {
    Complaint c = error.complaint();
    c.file = "command line";
    c.key = option;
    throw InputError(c);
  }
}

}  // namespace

Defaults defaults_of(const StatedDefaults& stated) {
  Defaults d;
  read_stated(stated.p_wave_speed, "--p-wave-speed", Dimension::velocity, d.p_wave_speed, d.stated_speed);
  read_stated(stated.poisson_ratio, "--poisson-ratio", Dimension::ratio, d.poisson_ratio, d.stated_poisson);
  read_stated(stated.shear_modulus, "--shear-modulus", Dimension::pressure, d.shear_modulus, d.stated_modulus);
  return d;
}

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
