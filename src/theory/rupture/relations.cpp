#include "slipfront/theory/rupture/relations.hpp"

#include <array>
#include <cfloat>
#include <cmath>
#include <numbers>
#include <string>

#include "math/digits.hpp"
#include "math/roots.hpp"
#include "slipfront/error.hpp"
#include "slipfront/math/elliptic.hpp"
#include "slipfront/theory/modulation/modulation.hpp"
#include "slipfront/theory/rupture/riemann.hpp"
#include "slipfront/theory/train.hpp"
#include "theory/rupture/inverse.hpp"

namespace slipfront::rupture {
namespace {

using std::numbers::pi;

/// Smallest inputs for which every output is a normal double. The first output to become too small is psi_at_origin,
/// about V / (ln V)^2.
constexpr double least_stress = 0.00447;
constexpr double least_rupture_velocity = 2e-302;
constexpr double least_slip_velocity = 7.2e-308;
/// Largest inputs for which no output overflows.
constexpr double most_stress = 1e308;
constexpr double most_slip_velocity = 5e307;
constexpr double most_psi = 18;  ///< above it, |V-| rounds to c

struct Range {
  const char* key;
  double least, most;
  const char* allowed;
};

void check(double value, const Range& range) {
  if (value >= range.least && value <= range.most) return;  // NaN fails both comparisons
  const char* problem = std::isnan(value)     ? "not a number"
                        : value <= 0          ? "not positive"
                        : value < range.least ? "too small: a result would be below the smallest double"
                                              : "too large";
  throw InputError({.key = range.key, .value = shortest(value), .problem = problem, .allowed = range.allowed});
}

/// Evaluates Eqs. 8-10 from psi on the stressed side and psi at x = 0. Throughout the fan, phi + psi = psi-.
Relations assemble(double psi, double psi_at_origin) {
  const elliptic::AtPsi left = elliptic::at_psi(psi), origin = elliptic::at_psi(psi_at_origin);
  const double phi0 = modulation::sound(psi_at_origin).rapidity;  // lambda_- = 0 on the ray x = 0
  const double cosh_psi0 = std::cosh(psi_at_origin);
  Relations r{};
  r.stress = pi * std::cosh(psi) / left.K;
  r.rupture_velocity = left.s / left.ratio;                          // Eq. (9): |V-| = c0(psi-)
  r.leading_velocity = left.s;                                       // V+ = tanh(psi-)
  r.velocity_ratio = 1 / left.ratio;                                 // K / E
  r.stress_at_origin = pi * std::cosh(phi0) * cosh_psi0 / origin.K;  // Eq. (8): Sigma = pi cosh(phi) cosh(psi) / K
  r.slip_velocity = pi * std::sinh(phi0) * cosh_psi0 / origin.K;     // Eq. (10): W(0) = Sigma U at phi0 + psi0 = psi-
  r.dislocation_velocity_at_origin = std::tanh(phi0);
  r.psi = psi;
  r.psi_at_origin = psi_at_origin;
  return r;
}

}  // namespace

Relations from_stress(double stress) {
  check(stress, {"stress", least_stress, most_stress, "0.00447 <= stress <= 1e308 (in mu A / pi)"});
  const double psi = train::psi_of_stress(stress);
  Relations r = assemble(psi, psi_of_fan(psi));
  r.stress = stress;
  return r;
}

Relations from_rupture_velocity(double rupture_velocity) {
  check(rupture_velocity,
        {"rupture_velocity", least_rupture_velocity, 1 - DBL_EPSILON / 2, "2e-302 <= rupture_velocity < 1 (in c)"});
  const double psi = psi_of_sound_speed(rupture_velocity);
  Relations r = assemble(psi, psi_of_fan(psi));
  r.rupture_velocity = rupture_velocity;
  return r;
}

Relations from_slip_velocity(double slip_velocity) {
  check(slip_velocity,
        {"slip_velocity", least_slip_velocity, most_slip_velocity, "7.2e-308 <= slip_velocity <= 5e307 (in c A / pi)"});
  const double psi0 = psi_of_origin_slip_velocity(slip_velocity);
  Relations r = assemble(psi0 + modulation::sound(psi0).rapidity, psi0);
  r.slip_velocity = slip_velocity;
  return r;
}

Relations from_psi(double psi) {
  check(psi, {"psi", least_rupture_velocity, most_psi, "2e-302 <= psi <= 18"});
  return assemble(psi, psi_of_fan(psi));
}

std::span<const RelationsQuantity> relations_quantities() {
  static constexpr RelationsQuantity quantities[] = {
      {{"stress", "Sigma-, stress before the rupture", "mu A / pi", "Eqs. 8-10"}, &Relations::stress},
      {{"rupture_velocity", "|V-| of the fast (trailing) front", "c", "Eqs. 8-10"}, &Relations::rupture_velocity},
      {{"leading_velocity", "V+ of the slow (leading) front", "c", "Eqs. 8-10"}, &Relations::leading_velocity},
      {{"velocity_ratio", "|V- / V+| = K / E", "", "Eqs. 8-10"}, &Relations::velocity_ratio},
      {{"slip_velocity", "W at x = 0", "c A / pi", "Eqs. 8-10"}, &Relations::slip_velocity},
      {{"stress_at_origin", "Sigma at x = 0", "mu A / pi", "Eqs. 8-10"}, &Relations::stress_at_origin},
      {{"dislocation_velocity_at_origin", "U at x = 0", "c", "Eqs. 8-10"}, &Relations::dislocation_velocity_at_origin},
      {{"psi", "psi of the stressed side, sqrt(1 - m) = tanh psi", "", "Eqs. 8-10"}, &Relations::psi},
      {{"psi_at_origin", "psi at x = 0", "", "Eqs. 8-10"}, &Relations::psi_at_origin},
  };
  return quantities;
}

namespace {

using std::numbers::pi;

}  // namespace

double psi_of_sound_speed(double V) {
  if (V > 0.5) {  // 1 - V is exact here, and 1 - c0 = m^2 / 16 keeps the digits that c0 loses
    const double rest = 1 - V;
    const auto residual = [rest](double psi) {
      const modulation::Sound c = modulation::sound(psi);
      return Residual{std::log(c.one_minus / rest), -psi * c.c0 * c.log_slope / c.one_minus};
    };
    const double m = 4 * std::sqrt(rest);
    return newton_in_log(m < 0.8 ? std::acosh(1 / std::sqrt(m)) : 0.3, residual, "psi of a rupture velocity");
  }
  const auto residual = [V](double psi) {
    const modulation::Sound c = modulation::sound(psi);
    return Residual{std::log(c.c0 / V), psi * c.log_slope};
  };
  const double L = std::log(4 / V);
  return newton_in_log(V / (L + std::log(L)), residual, "psi of a rupture velocity");
}

double psi_of_fan(double r) {
  const auto residual = [r](double psi) {
    const modulation::Sound c = modulation::sound(psi);
    const double sum = psi + c.rapidity;
    return Residual{std::log(sum / r), psi * (1 + c.slope) / sum};
  };
  const double L = 1 + std::log1p(4 / r);
  return newton_in_log(r < 2 ? r / (L + std::log(L)) : (r - 0.34) / 3, residual, "psi in the fan");
}

State state_in_left_fan(double upper_edge, double x_over_t) {
  const double above = upper_edge - std::atanh(x_over_t);
  if (!(above > 0)) return {upper_edge, 0};
  const double psi = psi_of_fan(above);
  return {upper_edge - psi, psi};
}

double psi_of_origin_slip_velocity(double W) {
  const auto residual = [W](double psi) {
    const elliptic::AtPsi at = elliptic::at_psi(psi);
    const modulation::Sound c = modulation::sound(psi);
    const double value = pi * std::sinh(c.rapidity) * std::cosh(psi) / at.K;
    return Residual{std::log(value / W),
                    psi * (c.slope / std::tanh(c.rapidity) + std::tanh(psi) - elliptic::log_slope_of_K(at))};
  };
  return newton_in_log(W < 1 ? W / pi : std::log(1 + 1.5 * W) / 3, residual, "psi of a slip velocity");
}

RiemannSolution slip_pulse(double stress) { return solve_riemann({0, from_stress(stress).psi}, State{}); }

std::string_view name_of(Wave::Kind kind) {
  static constexpr std::array<std::string_view, 4> names = {"none", "fan", "shock", "two-trains"};
  return names[static_cast<std::size_t>(kind)];
}

ProfilePoint profile_point(const State& state) {
  const train::Averages a = train::averages(state);
  return {state.empty() ? 0.0 : std::tanh(state.phi), a.k, a.W, a.P};
}

ProfilePoint profile_point(const RiemannSolution& solution, double x_over_t) {
  return profile_point(sample(solution, x_over_t));
}

std::span<const ProfileQuantity> profile_quantities() {
  static constexpr std::array<ProfileQuantity, 4> all = {{
      {{"U", "velocity of the dislocations", "c", "Eqs. 8-9"}, &ProfilePoint::U},
      {{"Sigma", "stress", "mu A / pi", "Eqs. 8-9"}, &ProfilePoint::Sigma},
      {{"W", "slip velocity", "c A / pi", "Eqs. 8-9"}, &ProfilePoint::W},
      {{"P", "momentum density", "", "Eqs. 8-9"}, &ProfilePoint::P},
  }};
  return all;
}

State moving_train(double stress, double velocity, const std::string& side) {
  constexpr double most_moving_stress = 1e6;
  if (!(std::fabs(velocity) <= 0.999999))
    throw InputError({.key = side + "_velocity",
                      .value = digits(velocity),
                      .problem = "out of range",
                      .allowed = "-0.999999 ... 0.999999, in c"});
  const double phi = std::atanh(velocity), at_rest = stress / std::cosh(phi);
  if (stress == 0) return {phi, 0};
  if (!(at_rest >= train::smallest_stress && stress <= most_moving_stress))
    throw InputError(
        {.key = side + "_stress",
         .value = digits(stress),
         .problem = "out of range",
         .allowed = "0, or " + digits(train::smallest_stress * std::cosh(phi), 4) + " ... 1e6, in mu A / pi"});
  return {phi, train::psi_of_stress(at_rest)};
}

}  // namespace slipfront::rupture
