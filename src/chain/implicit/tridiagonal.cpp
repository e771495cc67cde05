#include "chain/implicit/tridiagonal.hpp"

namespace slipfront::chain {

Tridiagonal::Tridiagonal(std::size_t rows)
    : below(rows), diagonal(rows), above(rows), scaled_(rows), per_pivot_(rows), correction_(rows) {}

void Tridiagonal::eliminate() {
  double pivot = diagonal[0];
  per_pivot_[0] = 1 / pivot;
  for (std::size_t i = 1; i < rows(); ++i) {
    scaled_[i] = above[i - 1] / pivot;
    pivot = diagonal[i] - below[i] * scaled_[i];
    per_pivot_[i] = 1 / pivot;
  }
}

void Tridiagonal::substitute(std::vector<double>& r) const {
  double last = r[0] *= per_pivot_[0];
  for (std::size_t i = 1; i < rows(); ++i) r[i] = last = (r[i] - below[i] * last) * per_pivot_[i];
  for (std::size_t i = rows() - 1; i > 0; --i) r[i - 1] = last = r[i - 1] - scaled_[i] * last;
}

void Tridiagonal::solve(std::vector<double>& right, bool cyclic) {
  if (!cyclic) {
    eliminate();
    substitute(right);
    return;
  }
  // Sherman and Morrison: the corners are a matrix of rank one added to a tridiagonal one.
  const std::size_t n = right.size();
  const double upper = below[0], lower = above[n - 1], gamma = -diagonal[0];
  diagonal[0] -= gamma;
  diagonal[n - 1] -= upper * lower / gamma;
  correction_.assign(n, 0);
  correction_[0] = gamma;
  correction_[n - 1] = lower;
  eliminate();
  substitute(right);
  substitute(correction_);
  const double share =
      (right[0] + upper * right[n - 1] / gamma) / (1 + correction_[0] + upper * correction_[n - 1] / gamma);
  for (std::size_t i = 0; i < n; ++i) right[i] -= share * correction_[i];
}

}  // namespace slipfront::chain
