#include <cmath>
#include <numbers>

#include "foundation/math/roots.hpp"
#include "slipfront/elliptic/complete.hpp"
#include "slipfront/train/train.hpp"

namespace slipfront::train {

using std::numbers::pi;

double psi_of_stress(double stress) {
  // Newton's method starts from the limit of a sparse or a dense train. For small stress, K = ln(4/psi) = pi/Sigma. For
  // large stress, K = pi/2 and Sigma = 2 cosh(psi).
  if (stress > 20) {
    const auto dense = [stress](double psi) {
      const elliptic::AtPsi at = elliptic::at_psi(psi);
      return Residual{std::log(pi * std::cosh(psi) / at.K / stress),
                      psi * (std::tanh(psi) - elliptic::log_slope_of_K(at))};
    };
    const double guess = std::log(stress);
    if (guess > elliptic::psi_dense_above + 1) return guess;  // Sigma = 2 cosh(psi) = exp(psi) up to rounding
    return newton_in_log(guess, dense, "psi of a stress");
  }
  const auto residual = [stress](double psi) {  // K - pi cosh(psi) / Sigma, linear in ln(psi) for small psi
    const elliptic::AtPsi at = elliptic::at_psi(psi);
    return Residual{at.K - pi * std::cosh(psi) / stress,
                    psi * (elliptic::log_slope_of_K(at) * at.K - pi * std::sinh(psi) / stress)};
  };
  const double bare = 4 * std::exp(-pi / stress);
  return newton_in_log(stress < 1 ? bare : std::log1p(bare), residual, "psi of a stress");
}

}  // namespace slipfront::train
