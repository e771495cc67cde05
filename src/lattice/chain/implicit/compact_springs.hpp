#pragma once

#include <cstddef>
#include <initializer_list>
#include <vector>

#include "lattice/chain/model/blocks.hpp"
#include "slipfront/lattice/chain/problem.hpp"
#include "system/ranks.hpp"

namespace slipfront::chain {

/// Solves A x = r with A tridiagonal, in place: `right` becomes x. `below[i]` and `above[i]` are next to the diagonal
/// in row i. Of a cyclic matrix, the first `below` and the last `above` are its corners; otherwise they are 0. Without
/// pivoting. The matrix is used up. Nothing is allocated after the constructor.
///
/// Several ranks may share the rows, each those of its sites. They eliminate one after the other, with the operations
/// and the order of a single process, and so get the same bits.
class Tridiagonal {
 public:
  /// A matrix with so many rows on this rank.
  explicit Tridiagonal(std::size_t rows = 0);
  /// (all) `right` has the rows of this rank.
  void solve(std::vector<double>& right, bool cyclic, const Ranks& ranks);

  std::vector<double> below, diagonal, above;

 private:
  void eliminate(std::vector<double>& right, const Ranks& ranks);
  void eliminate_cyclic(std::vector<double>& right, const Ranks& ranks);
  void move_corners(const Ranks& ranks, double upper, double gamma);
  std::vector<double> scaled_, correction_;
};

/// A number for each site of a rank, and for the site on either side of them.
class Bordered {
 public:
  explicit Bordered(std::size_t sites = 0) : values_(sites + 2) {}
  double& operator[](std::size_t j) { return values_[j + 1]; }
  double operator[](std::size_t j) const { return values_[j + 1]; }
  double before(std::size_t j) const { return values_[j]; }
  double after(std::size_t j) const { return values_[j + 2]; }
  std::size_t size() const { return values_.size() - 2; }

 private:
  friend class CompactSprings;
  std::vector<double> values_;
};

/// The force of the springs on each site of a rank, of fourth order in the spacing h:
///     (1 + m d2) force = d2 u / h^2,    m = 1/12 (Numerov), or 0 for the lattice of Eq. 1,
/// with the second difference d2. The diamond rule (docs/chain.md) has the same force at rest, so both schemes have the
/// same states at rest. d2 and 1 + m d2 commute and are symmetric with the weights of the sites. The force therefore
/// has an energy. At a free end, u is reflected. At a fixed end, both u and the force are given: the force is that of
/// the substrate there, less what drives the end (`drive`). The energy is that of the first part.
class CompactSprings {
 public:
  /// (all) `u` is the motion of the sites of this rank at the start. Sites count from the first of this rank on.
  CompactSprings(const Problem& problem, const std::vector<double>& u, const Ranks& ranks);

  const Ranks& ranks() const { return ranks_; }
  const OwnBlocks& own() const { return own_; }
  bool periodic() const { return periodic_; }
  bool at_left_end(std::size_t site) const { return site == 0 && left_end_; }
  bool at_right_end(std::size_t site) const { return site + 1 == n_ && right_end_; }
  bool held(std::size_t site) const {
    return (at_left_end(site) && left_fixed_) || (at_right_end(site) && right_fixed_);
  }
  /// The substrate's part of (u_tt + S + f - F) at a site that is held.
  double held_force(std::size_t site) const { return at_left_end(site) ? left_force_ : right_force_; }
  bool holds_an_end() const { return !given_.empty(); }
  /// The force on a site if the held ends are driven by these forces.
  double drive(std::size_t site, double at_left, double at_right) const {
    return (by_left_.empty() ? 0 : by_left_[site] * at_left) + (by_right_.empty() ? 0 : by_right_[site] * at_right);
  }
  /// h, or h / 2 for a site at an end.
  double weight(std::size_t site) const { return at_left_end(site) || at_right_end(site) ? h_ / 2 : h_; }
  double coupling() const { return m_; }
  double spacing() const { return h_; }

  /// (all) Fills the borders of up to four arrays: from the ranks next to this one, reflected at an end of the chain.
  void exchange(std::initializer_list<Bordered*> arrays) const;
  /// d2 u / h^2 at a site.
  double bend(const Bordered& u, std::size_t site) const;
  /// (1 + m d2) q at a site.
  double spread(const Bordered& q, std::size_t site) const {
    return q[site] + m_ * ((q.before(site) - q[site]) + (q.after(site) - q[site]));
  }
  /// (all) The energy of the springs, up to a constant that depends only on the chain.
  double energy(const std::vector<double>& u) const;

 private:
  std::vector<double> force(std::vector<double> right) const;
  std::vector<double> force_of_end(bool on_this_rank, std::size_t neighbour) const;

  const Ranks& ranks_;
  OwnBlocks own_;
  std::size_t n_;  ///< sites of this rank
  double h_, m_, jump_;
  bool periodic_, left_fixed_, right_fixed_;
  bool left_end_, right_end_;  ///< whether an end of the chain is on this rank; a ring has none
  double left_force_ = 0, right_force_ = 0;
  /// Force on each site, through m, of a held end that is driven by 1; empty if that end is not held.
  std::vector<double> by_left_, by_right_;
  std::vector<double> given_;  ///< less the force on each site from the substrate of held ends; empty if none is held
};

}  // namespace slipfront::chain
