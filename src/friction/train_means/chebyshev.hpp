#pragma once

#include <cmath>
#include <cstddef>
#include <cstring>
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

/// A polynomial in x and y over [-1, 1] x [-1, 1]: a patch of a table.
struct ChebyshevPatch {
  static constexpr std::size_t terms = 8;
  using Fit = ChebyshevFit<terms>;
  using Values = double[terms][terms];  ///< at extremum i of x and extremum k of y

  double c[terms][terms];  ///< powers of x by powers of y

  void fit(const Fit& through, const Values& values) {
    double over_y[terms][terms], column[terms], powers[terms];
    for (std::size_t i = 0; i < terms; ++i) through(values[i], over_y[i]);
    for (std::size_t k = 0; k < terms; ++k) {
      for (std::size_t i = 0; i < terms; ++i) column[i] = over_y[i][k];
      through(column, powers);
      for (std::size_t i = 0; i < terms; ++i) c[i][k] = powers[i];
    }
  }
};

struct ValueAndSlope {
  double value, by_x;
};

/// The polynomial and its derivative in x. Inlined, to become the vector code of the loop it is in.
[[gnu::always_inline]] inline ValueAndSlope interpolate(const ChebyshevPatch& patch, double x, double y) {
  // Coefficients of eight powers of y as one value: compilers make vector code of it that they do not make of loops
  // over eight.
  using Row = double __attribute__((vector_size(ChebyshevPatch::terms * sizeof(double))));
  const double y2 = y * y, y4 = y2 * y2;
  Row row, value = {}, by_x = {};
  for (std::size_t j = ChebyshevPatch::terms; j-- > 0;) {
    std::memcpy(&row, patch.c[j], sizeof row);
    by_x = by_x * x + value;
    value = value * x + row;
  }
  // Both sums over powers of y, half of them by half.
  const Row low = __builtin_shufflevector(value, by_x, 0, 1, 2, 3, 8, 9, 10, 11),
            high = __builtin_shufflevector(value, by_x, 4, 5, 6, 7, 12, 13, 14, 15), four = low + y4 * high,
            two = four + y2 * __builtin_shufflevector(four, four, 2, 3, 2, 3, 6, 7, 6, 7);
  return {two[0] + y * two[1], two[4] + y * two[5]};
}

}  // namespace slipfront::friction
