#include "chain/implicit/compact_springs.hpp"

#include <cmath>
#include <numbers>
#include <utility>

#include "chain/implicit/tridiagonal.hpp"

namespace slipfront::chain {

CompactSprings::CompactSprings(const Problem& p, const std::vector<double>& u)
    : n_(p.grid.sites),
      h_(p.grid.spacing),
      m_(p.model == Model::lattice ? 0 : 1.0 / 12),
      jump_(2 * std::numbers::pi * static_cast<double>(p.boundary.charge)),
      periodic_(p.boundary.periodic),
      left_fixed_(!periodic_ && p.boundary.left == End::fixed),
      right_fixed_(!periodic_ && p.boundary.right == End::fixed) {
  const auto substrate = [&](std::size_t j) {
    const double a = !p.substrate ? 0 : p.contact ? p.contact(p.grid.x(j)) : 1;
    return a * a * std::sin(u[j]);
  };
  if (!left_fixed_ && !right_fixed_) return;
  std::vector<double> right(n_, 0.0);
  if (left_fixed_) {
    left_force_ = substrate(0);
    right[1] += m_ * left_force_;
  }
  if (right_fixed_) {
    right_force_ = substrate(n_ - 1);
    right[n_ - 2] += m_ * right_force_;
  }
  given_ = force(std::move(right));
}

double CompactSprings::bend(const std::vector<double>& u, std::size_t j) const {
  const double h2 = h_ * h_;
  if (j > 0 && j + 1 < n_) return ((u[j + 1] - u[j]) - (u[j] - u[j - 1])) / h2;
  if (periodic_)
    return j == 0 ? ((u[1] - u[0]) - (u[0] - u[n_ - 1] - jump_)) / h2
                  : ((u[0] - jump_ - u[j]) - (u[j] - u[j - 1])) / h2;
  return 2 * (j == 0 ? u[1] - u[0] : u[j - 1] - u[j]) / h2;
}

double CompactSprings::spread(const std::vector<double>& q, std::size_t j) const {
  const double left = q[j > 0 ? j - 1 : periodic_ ? n_ - 1 : 1];
  const double right = q[j + 1 < n_ ? j + 1 : periodic_ ? 0 : j - 1];
  return q[j] + m_ * ((left - q[j]) + (right - q[j]));
}

std::vector<double> CompactSprings::force(std::vector<double> right) const {
  Tridiagonal matrix(n_);
  for (std::size_t j = 0; j < n_; ++j) {
    matrix.below[j] = matrix.above[j] = m_;
    matrix.diagonal[j] = 1 - 2 * m_;
  }
  if (!periodic_) {
    matrix.above[0] = matrix.below[n_ - 1] = 2 * m_;
    for (const std::size_t j : {std::size_t{0}, n_ - 1}) {
      if (!held(j)) continue;
      matrix.diagonal[j] = 1;
      matrix.above[j] = matrix.below[j] = right[j] = 0;
    }
  }
  matrix.solve(right, periodic_);
  return right;
}

double CompactSprings::energy(const std::vector<double>& u) const {
  std::vector<double> bends(n_);
  for (std::size_t j = 0; j < n_; ++j) bends[j] = bend(u, j);
  const std::vector<double> forces = force(std::move(bends));
  // Displacements from a line that the springs do not feel: with a ring's charge, or between two fixed ends.
  const bool inclined = periodic_ || (left_fixed_ && right_fixed_);
  const double intervals = static_cast<double>(periodic_ ? n_ : n_ - 1);
  const double rise = periodic_ ? -jump_ : inclined ? u[n_ - 1] - u[0] : 0;
  const double start = left_fixed_ || periodic_ ? u[0] : right_fixed_ ? u[n_ - 1] : u[0];
  double sum = rise * rise / (2 * h_ * intervals);
  for (std::size_t j = 0; j < n_; ++j) {
    if (held(j)) continue;
    const double from_line = u[j] - start - rise * static_cast<double>(j) / intervals;
    sum -= weight(j) * from_line * forces[j] / 2;
    if (!given_.empty()) sum += weight(j) * (u[j] - start) * given_[j];
  }
  return sum;
}

}  // namespace slipfront::chain
