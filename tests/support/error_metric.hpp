#pragma once

#include <cfloat>
#include <cmath>
#include <limits>

/// The one error metric of all tables: |got - want| / |want| in units of the machine epsilon. Two NaNs agree, equal
/// infinities agree, a zero agrees with zero alone; any other mixture of those is infinitely wrong. Below the normal
/// range, where a double has fewer digits, the error counts in units of the smallest normal number.
inline double error_in_eps(double got, double want) {
  if (std::isnan(got) || std::isnan(want))
    return std::isnan(got) && std::isnan(want) ? 0 : std::numeric_limits<double>::infinity();
  if (got == want) return 0;
  if (std::isinf(got) || std::isinf(want) || want == 0) return std::numeric_limits<double>::infinity();
  return std::fabs(got - want) / std::fmax(std::fabs(want), DBL_MIN) / DBL_EPSILON;
}
