#pragma once

#include <array>
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

/// Weights of the values at 0, 1, ..., n - 1, up to six of them, in the polynomial through them at s. It divides by no
/// distance, and so is fast.
inline std::array<double, 6> equidistant_weights(std::size_t n, double s) {
  constexpr double inverse_factorial[] = {1, 1, 1.0 / 2, 1.0 / 6, 1.0 / 24, 1.0 / 120};
  std::array<double, 6> weights{};
  double product = 1;
  for (std::size_t j = 0; j < n; ++j) {
    weights[j] = product * inverse_factorial[j];
    product *= s - static_cast<double>(j);
  }
  product = 1;
  for (std::size_t j = n; j-- > 0;) {
    weights[j] *= product * inverse_factorial[n - 1 - j];
    product *= static_cast<double>(j) - s;  // the sign alternates
  }
  return weights;
}

}  // namespace slipfront
