#pragma once

#include <cstddef>
#include <vector>

#include "slipfront/chain/problem.hpp"

namespace slipfront::chain {

/// The force of the springs on each site, of fourth order in the spacing h:
///     (1 + m d2) force = d2 u / h^2,    m = 1/12 (Numerov), or 0 for the lattice of Eq. 1,
/// with the second difference d2. The diamond rule (docs/chain.md) has the same force at rest, so both schemes have the
/// same states at rest. d2 and 1 + m d2 commute and are symmetric with the weights of the sites. The force therefore
/// has an energy. At a free end, u is reflected. At a fixed end, both u and the force are given; the force is that of
/// the substrate there.
class CompactSprings {
 public:
  CompactSprings(const Problem& problem, const std::vector<double>& u);

  bool periodic() const { return periodic_; }
  bool held(std::size_t site) const { return (site == 0 && left_fixed_) || (site + 1 == n_ && right_fixed_); }
  /// The value of (u_tt + S + f - F) at a site that is held.
  double held_force(std::size_t site) const { return site == 0 ? left_force_ : right_force_; }
  /// h, or h / 2 for a site at an end.
  double weight(std::size_t site) const { return !periodic_ && (site == 0 || site + 1 == n_) ? h_ / 2 : h_; }
  double coupling() const { return m_; }
  double spacing() const { return h_; }

  /// d2 u / h^2 at a site.
  double bend(const std::vector<double>& u, std::size_t site) const;
  /// (1 + m d2) q at a site.
  double spread(const std::vector<double>& q, std::size_t site) const;
  /// The energy of the springs, up to a constant that depends only on the chain.
  double energy(const std::vector<double>& u) const;

 private:
  std::vector<double> force(std::vector<double> right) const;

  std::size_t n_;
  double h_, m_, jump_;
  bool periodic_, left_fixed_, right_fixed_;
  double left_force_ = 0, right_force_ = 0;
  std::vector<double> given_;  ///< force on each site from the held ends, through m; empty if no end is held
};

}  // namespace slipfront::chain
