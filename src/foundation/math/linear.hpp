#pragma once

#include <cmath>
#include <cstddef>
#include <initializer_list>
#include <utility>
#include <vector>

namespace slipfront {

/// Solves A x = b for a few unknowns and several right sides, which become the solutions. A is square, row by row. The
/// pivots are scaled by their rows.
inline void solve_linear(std::vector<double> matrix, std::initializer_list<std::vector<double>*> sides) {
  const std::size_t n = (*sides.begin())->size();
  std::vector<double> scale(n);
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < n; ++j) scale[i] = std::fmax(scale[i], std::fabs(matrix[i * n + j]));
  for (std::size_t j = 0; j < n; ++j) {
    std::size_t best = j;
    for (std::size_t i = j + 1; i < n; ++i)
      if (std::fabs(matrix[i * n + j]) * scale[best] > std::fabs(matrix[best * n + j]) * scale[i]) best = i;
    if (best != j) {
      for (std::size_t k = 0; k < n; ++k) std::swap(matrix[best * n + k], matrix[j * n + k]);
      std::swap(scale[best], scale[j]);
      for (std::vector<double>* b : sides) std::swap((*b)[best], (*b)[j]);
    }
    for (std::size_t i = j + 1; i < n; ++i) {
      const double factor = matrix[i * n + j] / matrix[j * n + j];
      for (std::size_t k = j + 1; k < n; ++k) matrix[i * n + k] -= factor * matrix[j * n + k];
      for (std::vector<double>* b : sides) (*b)[i] -= factor * (*b)[j];
    }
  }
  for (std::vector<double>* b : sides)
    for (std::size_t j = n; j-- > 0;) {
      for (std::size_t k = j + 1; k < n; ++k) (*b)[j] -= matrix[j * n + k] * (*b)[k];
      (*b)[j] /= matrix[j * n + j];
    }
}

}  // namespace slipfront
