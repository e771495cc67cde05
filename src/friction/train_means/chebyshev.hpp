#pragma once

#include <cmath>
#include <cstddef>
#include <numbers>

namespace slipfront::friction {

/// Polynomials of n terms over t in [-1, 1] through values at the extrema of Chebyshev's polynomial of degree n - 1.
template <std::size_t n>
class ChebyshevFit {
 public:
  ChebyshevFit() {
    double in_powers[n][n] = {{1}, {0, 1}};  // coefficients of the T_k
    for (std::size_t k = 2; k < n; ++k)
      for (std::size_t j = 0; j < n; ++j)
        in_powers[k][j] = (j > 0 ? 2 * in_powers[k - 1][j - 1] : 0) - in_powers[k - 2][j];
    const auto half_at_end = [](std::size_t i) { return i == 0 || i == n - 1 ? 0.5 : 1.0; };
    for (std::size_t j = 0; j < n; ++j)
      for (std::size_t i = 0; i < n; ++i)
        for (std::size_t k = 0; k < n; ++k)
          by_value_[j][i] += in_powers[k][j] * half_at_end(k) * half_at_end(i) * 2 / (n - 1) * extremum(i * k);
  }

  /// Extremum i, from 1 down to -1.
  static double extremum(std::size_t i) { return std::cos(std::numbers::pi * static_cast<double>(i) / (n - 1)); }

  /// Computes the coefficients of the powers of t from the values at the extrema.
  void operator()(const double (&values)[n], double (&c)[n]) const {
    for (std::size_t j = 0; j < n; ++j) {
      c[j] = 0;
      for (std::size_t i = 0; i < n; ++i) c[j] += by_value_[j][i] * values[i];
    }
  }

 private:
  double by_value_[n][n] = {};
};

}  // namespace slipfront::friction
