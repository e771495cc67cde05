#include "lattice/chain/implicit/compact_springs.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <span>
#include <utility>

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

CompactSprings::CompactSprings(const Problem& p, const std::vector<double>& u, const Ranks& ranks)
    : ranks_(ranks),
      own_(p.grid.sites, ranks),
      n_(own_.size()),
      h_(p.grid.spacing),
      m_(p.model == Model::lattice ? 0 : 1.0 / 12),
      jump_(2 * std::numbers::pi * static_cast<double>(p.boundary.charge)),
      periodic_(p.boundary.periodic),
      left_fixed_(!periodic_ && p.boundary.left == End::fixed),
      right_fixed_(!periodic_ && p.boundary.right == End::fixed),
      left_end_(!periodic_ && own_.begin == 0),
      right_end_(!periodic_ && own_.end == p.grid.sites) {
  const auto substrate = [&](std::size_t j) {
    const double a = !p.substrate ? 0 : p.contact ? p.contact(p.grid.x(own_.begin + j)) : 1;
    return a * a * std::sin(u[j]);
  };
  if (left_fixed_ && left_end_) left_force_ = substrate(0);
  if (right_fixed_ && right_end_) right_force_ = substrate(n_ - 1);
  if (left_fixed_) by_left_ = force_of_end(left_end_, 1);
  if (right_fixed_) by_right_ = force_of_end(right_end_, n_ - 2);
  if (!left_fixed_ && !right_fixed_) return;
  const std::vector<double> forces = ranks_.joined({left_force_, right_force_});
  for (std::size_t j = 0; j < n_; ++j) given_.push_back(drive(j, forces.front(), forces.back()));
}

/// (all) `neighbour` is the site next to the end, if that is `on_this_rank`.
std::vector<double> CompactSprings::force_of_end(bool on_this_rank, std::size_t neighbour) const {
  std::vector<double> right(n_, 0.0);
  if (on_this_rank) right[neighbour] = m_;
  return force(std::move(right));
}

void CompactSprings::exchange(std::initializer_list<Bordered*> arrays) const {
  std::array<double, 4> to_left, to_right, from_left, from_right;
  std::size_t count = 0;
  for (const Bordered* values : arrays) {
    to_left[count] = (*values)[0];
    to_right[count] = (*values)[n_ - 1];
    from_left[count] = (*values)[1];
    from_right[count++] = (*values)[n_ - 2];
  }
  const auto first = [count](std::array<double, 4>& numbers) { return std::span(numbers).first(count); };
  ranks_.exchange(first(to_left), first(to_right), first(from_left), first(from_right), periodic_);
  count = 0;
  for (Bordered* values : arrays) {
    values->values_.front() = from_left[count];
    values->values_.back() = from_right[count++];
  }
}

double CompactSprings::bend(const Bordered& u, std::size_t j) const {
  double before = u[j] - u.before(j), after = u.after(j) - u[j];
  if (periodic_ && j == 0 && own_.begin == 0) before -= jump_;
  if (periodic_ && j + 1 == n_ && own_.end == own_.blocks.sites) after = u.after(j) - jump_ - u[j];
  return (after - before) / (h_ * h_);
}

std::vector<double> CompactSprings::force(std::vector<double> right) const {
  Tridiagonal matrix(n_);
  for (std::size_t j = 0; j < n_; ++j) {
    matrix.diagonal[j] = held(j) ? 1 : 1 - 2 * m_;
    matrix.below[j] = held(j) || at_left_end(j) ? 0 : at_right_end(j) ? 2 * m_ : m_;
    matrix.above[j] = held(j) || at_right_end(j) ? 0 : at_left_end(j) ? 2 * m_ : m_;
    if (held(j)) right[j] = 0;
  }
  matrix.solve(right, periodic_, ranks_);
  return right;
}

double CompactSprings::energy(const std::vector<double>& u) const {
  Bordered all(n_);
  std::copy(u.begin(), u.end(), &all[0]);
  exchange({&all});
  std::vector<double> bends(n_);
  for (std::size_t j = 0; j < n_; ++j) bends[j] = bend(all, j);
  const std::vector<double> forces = force(std::move(bends)), ends = ranks_.joined({u.front(), u.back()});
  const double first = ends.front(), last = ends.back();
  // Displacements from a line that the springs do not feel: with a ring's charge, or between two fixed ends.
  const bool inclined = periodic_ || (left_fixed_ && right_fixed_);
  const double intervals = static_cast<double>(periodic_ ? own_.blocks.sites : own_.blocks.sites - 1);
  const double rise = periodic_ ? -jump_ : inclined ? last - first : 0;
  const double start = right_fixed_ && !left_fixed_ && !periodic_ ? last : first;
  const auto energy_at = [&](std::size_t j) {
    if (held(j)) return 0.0;
    const double from_line = u[j] - start - rise * static_cast<double>(own_.begin + j) / intervals;
    const double by_ends = given_.empty() ? 0 : (u[j] - start) * given_[j];
    return weight(j) * (by_ends - from_line * forces[j] / 2);
  };
  return rise * rise / (2 * h_ * intervals) + own_.sum(ranks_, energy_at);
}

}  // namespace slipfront::chain
