#pragma once

#include <cfloat>
#include <cmath>
#include <limits>

/// The error metric of all tables: |got - want| / |want| in units of the machine epsilon. Two NaNs agree, equal
/// infinities agree, and zero agrees only with zero. Any other mixture of those has an infinite error. Below the normal
/// range a double has fewer digits, so we divide by the smallest normal number there.
inline double error_in_eps(double got, double want) {
  if (std::isnan(got) || std::isnan(want))
    return std::isnan(got) && std::isnan(want) ? 0 : std::numeric_limits<double>::infinity();
  if (got == want) return 0;
  if (std::isinf(got) || std::isinf(want) || want == 0) return std::numeric_limits<double>::infinity();
  return std::fabs(got - want) / std::fmax(std::fabs(want), DBL_MIN) / DBL_EPSILON;
}
