#pragma once

#include <cmath>

#include "foundation/simd/elementary.hpp"

namespace slipfront::friction {

/// The force f = a asinh(w G), G = exp(base + share ln theta), of a position whose state is theta.
struct AsinhForce {
  double a = 0;
  double base = 0;
  double share = 0;

  double exponent(double theta) const { return base + share * std::log(theta); }
  SLIPFRONT_INLINE double exponent_branch_free(double theta) const {
    return base + share * log_branch_free(at_least(theta, least_theta));
  }

  static constexpr double least_theta = 1e-300;
};

}  // namespace slipfront::friction
