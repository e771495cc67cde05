#include "slipfront/rupture/relations.hpp"

#include <cfloat>
#include <cmath>
#include <numbers>
#include <string>

#include "foundation/text/digits.hpp"
#include "rupture/inverse.hpp"
#include "slipfront/elliptic/complete.hpp"
#include "slipfront/error.hpp"
#include "slipfront/modulation/characteristics.hpp"
#include "slipfront/train/train.hpp"

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

}  // namespace slipfront::rupture
