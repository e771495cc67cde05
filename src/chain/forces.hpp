#pragma once

#include <vector>

#include "scheme.hpp"
#include "slab.hpp"

namespace slipfront::chain {

/// What acts on a site besides springs, a substrate of strength 1 and viscous friction. Where there is nothing of it a
/// chain advances many levels at a time; else level by level, through here.
class Forces {
 public:
  /// Arrays reach this far beyond both ends: what a window of a few sites beyond them needs.
  static constexpr std::size_t beyond = 16;

  /// On sites [begin, end), and `beyond`: around a periodic chain, reflected at the ends of others.
  Forces(const Problem& problem, const Scheme& scheme, long level, std::size_t begin, std::size_t end);

  bool none() const { return a2_.empty() && drive_.empty() && !dry_; }
  /// a(x)^2 from site j on; null where it is 1.
  const double* a2(long j) const { return a2_.empty() ? nullptr : a2_.data() + at(j); }
  /// F in b / 2 pi at site j, now; and its rate of change. 0 where there is none.
  double now(long j) const { return F_now_.empty() ? 0.0 : F_now_[at(j)]; }
  double next(long j) const { return F_next_.empty() ? 0.0 : F_next_[at(j)]; }
  double rate(long j) const { return F_now_.empty() ? 0.0 : (F_next_[at(j)] - F_old_[at(j)]) / (2 * dt_); }

  /// One level of `size` sites, the first of which is site `offset` of the chain; arrays count from it and have two
  /// neighbours before and ten behind. `next` holds the level before on entry. `y` and `before` are room for work.
  void level(const Sides& sides, long offset, std::size_t size, const double* now, double* next, double* y,
             double* before, Outflow& outflow) const;
  /// To the next level of the forcing.
  void proceed();

  /// The friction force at velocity u_t.
  double friction(double velocity) const;
  /// u from z, both in turns, of `size` sites from site j on; `S` is room for work.
  void displacements_from(long j, std::size_t size, const double* z, double* u, double* S) const {
    displacements(sine_, scheme_.eps, a2(j), z, u, S, size);
  }

 private:
  std::size_t at(long j) const { return static_cast<std::size_t>(j - first_); }
  std::vector<double> forcing_at(long level) const;
  void find_drive();
  void add_friction(std::size_t begin, std::size_t end, const double* now, double* next, const double* before) const;

  Problem problem_;
  Scheme scheme_;
  PeriodicForce sine_;
  double dt_;
  long level_;
  long first_, last_;  ///< sites of the arrays' first element and behind their last
  bool dry_;
  std::vector<double> a2_, F_old_, F_now_, F_next_, drive_;
};

/// v + weight f(v) = free, where f opposes v: the velocity that friction leaves of `free`.
double velocity_left(const modulation::Friction& friction, double weight, double free);

}  // namespace slipfront::chain
