#include "chain/implicit/tridiagonal.hpp"

#include <array>
#include <span>

namespace slipfront::chain {

using enum Ranks::Neighbour;

Tridiagonal::Tridiagonal(std::size_t rows)
    : below(rows), diagonal(rows), above(rows), scaled_(rows), correction_(rows) {}

void Tridiagonal::solve(std::vector<double>& right, bool cyclic, const Ranks& ranks) {
  if (cyclic)
    eliminate_cyclic(right, ranks);
  else
    eliminate(right, ranks);
}

void Tridiagonal::eliminate(std::vector<double>& right, const Ranks& ranks) {
  const std::size_t n = right.size();
  std::vector<double>& c = scaled_;
  std::array<double, 3> row{1, 0, 0};  // pivot, above and right side of the row before
  ranks.receive(previous, row);
  auto [pivot, over, r] = row;
  for (std::size_t i = 0; i < n; ++i) {
    c[i] = over / pivot;
    pivot = diagonal[i] - below[i] * c[i];
    over = above[i];
    r = right[i] = (right[i] - below[i] * r) * (1 / pivot);
  }
  row = {pivot, over, r};
  ranks.send(next, row);
  std::array<double, 2> later{};  // the factor by which the row after changes this one, and its result
  ranks.receive(next, later);
  auto [factor, x] = later;
  for (std::size_t i = n; i-- > 0;) {
    x = right[i] -= factor * x;
    factor = c[i];
  }
  later = {factor, x};
  ranks.send(previous, later);
}

/// Moves the corners of the matrix into the diagonal and the correction. `upper` is the corner of the first row.
void Tridiagonal::move_corners(const Ranks& ranks, double upper, double gamma) {
  correction_.assign(diagonal.size(), 0);
  if (ranks.rank() == 0) {
    diagonal.front() -= gamma;
    correction_.front() = gamma;
  }
  if (ranks.rank() + 1 == ranks.size()) {
    const double lower = above.back();
    diagonal.back() -= upper * lower / gamma;
    correction_.back() = lower;
  }
}

/// Sherman and Morrison: the corners are a matrix of rank one added to a tridiagonal one.
void Tridiagonal::eliminate_cyclic(std::vector<double>& right, const Ranks& ranks) {
  const std::size_t n = right.size();
  std::vector<double>& c = scaled_;
  // Pivot, above, right side and correction of the row before; the corner of the first row, and gamma.
  std::array<double, 6> row{1, 0, 0, 0, below[0], -diagonal[0]};
  ranks.receive(previous, row);
  auto [pivot, over, r, q, upper, gamma] = row;
  move_corners(ranks, upper, gamma);
  for (std::size_t i = 0; i < n; ++i) {
    c[i] = over / pivot;
    pivot = diagonal[i] - below[i] * c[i];
    over = above[i];
    const double per_pivot = 1 / pivot;
    r = right[i] = (right[i] - below[i] * r) * per_pivot;
    q = correction_[i] = (correction_[i] - below[i] * q) * per_pivot;
  }
  row = {pivot, over, r, q, upper, gamma};
  ranks.send(next, row);
  // The factor by which the row after changes this one, its result and correction, and those of the last row.
  std::array<double, 5> later{0, 0, 0, r, q};
  ranks.receive(next, later);
  auto [factor, x, y, last_x, last_y] = later;
  for (std::size_t i = n; i-- > 0;) {
    x = right[i] -= factor * x;
    y = correction_[i] -= factor * y;
    factor = c[i];
  }
  later = {factor, x, y, last_x, last_y};
  ranks.send(previous, later);
  double share = (x + upper * last_x / gamma) / (1 + y + upper * last_y / gamma);
  ranks.from_first({&share, 1});
  for (std::size_t i = 0; i < n; ++i) right[i] -= share * correction_[i];
}

}  // namespace slipfront::chain
