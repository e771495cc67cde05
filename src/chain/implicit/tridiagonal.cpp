#include "chain/implicit/tridiagonal.hpp"

namespace slipfront::chain {

Tridiagonal::Tridiagonal(std::size_t rows)
    : below(rows), diagonal(rows), above(rows), scaled_(rows), correction_(rows) {}

void Tridiagonal::eliminate(std::vector<double>& r) {
  const std::size_t n = r.size();
  std::vector<double>& c = scaled_;
  double pivot = diagonal[0];
  r[0] /= pivot;
  for (std::size_t i = 1; i < n; ++i) {
    c[i] = above[i - 1] / pivot;
    pivot = diagonal[i] - below[i] * c[i];
    r[i] = (r[i] - below[i] * r[i - 1]) / pivot;
  }
  for (std::size_t i = n - 1; i > 0; --i) r[i - 1] -= c[i] * r[i];
}

void Tridiagonal::solve(std::vector<double>& right, bool cyclic) {
  if (!cyclic) {
    eliminate(right);
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
  eliminate(right);
  eliminate(correction_);
  const double share =
      (right[0] + upper * right[n - 1] / gamma) / (1 + correction_[0] + upper * correction_[n - 1] / gamma);
  for (std::size_t i = 0; i < n; ++i) right[i] -= share * correction_[i];
}

}  // namespace slipfront::chain
