#include "rupture/inverse.hpp"

#include <cmath>
#include <numbers>

#include "foundation/math/roots.hpp"
#include "slipfront/elliptic/complete.hpp"
#include "slipfront/modulation/characteristics.hpp"

namespace slipfront::rupture {
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

}  // namespace slipfront::rupture
