#pragma once

#include <cstddef>

namespace slipfront {

/// Value at x of the polynomial through n points (at[j], f[j]) with distinct at[j].
inline double lagrange(std::size_t n, const double* at, const double* f, double x) {
  double sum = 0;
  for (std::size_t j = 0; j < n; ++j) {
    double weight = 1;
    for (std::size_t m = 0; m < n; ++m)
      if (m != j) weight *= (x - at[m]) / (at[j] - at[m]);
    sum += weight * f[j];
  }
  return sum;
}

}  // namespace slipfront
