#pragma once

#include <cstddef>
#include <cstring>

#include "friction/train_means/chebyshev.hpp"

namespace slipfront::friction {

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
