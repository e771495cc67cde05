#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <initializer_list>
#include <utility>
#include <vector>

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

/// slope x + curve x^2, from 0 at x = 0.
struct Parabola {
  double slope, curve;
};

/// The one that rises by `rise_a` to x = a and by `rise_b` to x = b.
inline Parabola parabola_through(double a, double rise_a, double b, double rise_b) {
  const double fa = rise_a / a, fb = rise_b / b, curve = (fb - fa) / (b - a);
  return {fa - curve * a, curve};
}

}  // namespace slipfront
