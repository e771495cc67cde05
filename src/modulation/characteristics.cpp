#include "slipfront/modulation/characteristics.hpp"

#include <cmath>

#include "slipfront/elliptic/complete.hpp"

namespace slipfront::modulation {

Sound sound(double psi) {
  const elliptic::AtPsi at = elliptic::at_psi(psi);
  const double c0 = at.s / at.ratio;  // tanh(psi) K / E
  const double one_minus = at.excess / at.ratio;
  const double one_minus_square = one_minus * (1 + c0);
  // In the dense limit 1 - c0 = exp(-4 psi) underflows long before its logarithm does.
  const double rapidity = psi > elliptic::psi_dense_above ? 2 * psi + 0.5 * std::log(2.0)
                          : c0 < 0.5                      ? std::atanh(c0)
                                                          : 0.5 * std::log((1 + c0) / one_minus);
  // d(ln c0)/d(psi) = (1 - E/K)(E/K - m1) / (s E/K), from dK/dm and dE/dm.
  const double log_slope = at.deficit * at.above_m1 / (at.s * at.ratio);
  const double slope = psi > elliptic::psi_dense_above ? 2.0 : c0 * log_slope / one_minus_square;
  return {c0, one_minus, rapidity, slope, log_slope};
}

Speeds characteristic_speeds(const State& state) {
  if (state.empty()) return {std::tanh(state.phi), std::tanh(state.phi)};
  const double a = sound(state.psi).rapidity;
  // Eq. (6), for the invariants phi +- psi: (phi +- psi)_t + lambda_+- (phi +- psi)_x = 0.
  return {std::tanh(state.phi - a), std::tanh(state.phi + a)};
}

}  // namespace slipfront::modulation
