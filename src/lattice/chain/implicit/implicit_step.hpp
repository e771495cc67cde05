#pragma once

#include <cstddef>
#include <vector>

#include "lattice/chain/implicit/compact_springs.hpp"
#include "lattice/chain/implicit/site_forces.hpp"

namespace slipfront::chain {

/// A trial step of any length from a moment. With the mean velocity p = (v + v') / 2 of the step, it solves
///     u' = u + dt p,    (v' - v) / dt + S + f - F = springs((u + u') / 2),    S = a^2 (cos u - cos u') / (u' - u).
/// This is the midpoint rule with a discrete gradient. Conservative forces conserve energy for every dt, so work and
/// energy balance up to the residual of Newton's method. Friction is evaluated with the state at the middle of the step
/// and at the velocity
///     w = p + (eta / 2)(v' - v - dt a),
/// with the acceleration a of the step before. The bracket is of second order, like the rule. At a site that friction
/// holds, the midpoint rule would leave a velocity that changes its sign at every step. The bracket damps it. There eta
/// is 1/3; it is 0 if friction is slow. If contacts change with the state, a^2 is the mean of its values at both ends
/// of the step. The step then also adds up the energy given to the substrate, (a'^2 - a^2)(1 - (cos u + cos u') / 2).
class ImplicitStep {
 public:
  /// Allocates all memory that the steps need. `forces` must outlive this object. Sites count from the first of this
  /// rank on.
  ImplicitStep(const SiteForces& forces, int threads);

  /// (all) Finds the velocities at the end of a step with Newton's method. Returns whether the method converged.
  bool solve(const ChainState& from, double dt);
  /// (all) The largest error of the step that `solve` found, divided by the tolerance. It considers u, u_t and the
  /// logarithm of the state variables.
  double error(const ChainState& from, double dt);
  /// Takes the step that `solve` found: advances `m`, from which it was tried, to the end of the step, except its time.
  void take(ChainState& m, double dt) const;
  /// (all) After `solve` has failed: x of the first site without a finite force, or else of the site whose forces are
  /// farthest from balance.
  double hardest_position() const;

 private:
  void prepare(const ChainState& from, double dt);
  void evaluate(std::size_t j, double dt);
  double friction_at(std::size_t j, double w, double dt) const;
  void find_friction(std::size_t first, std::size_t size, const double* w, double dt, double* force) const;
  void rub(std::size_t first, std::size_t size, double dt);
  void evaluate_all(double dt);
  double velocity_under_friction(std::size_t j, double change, double dt) const;
  void build_matrix(double dt);
  enum class Outcome { converged, improved, failed };  ///< the worst of all sites is the last
  Outcome correct(double dt);
  void find_errors(std::size_t first, std::size_t size, double dt);
  double creep_error(std::size_t j, double dt) const;
  void find_state_errors(std::size_t first, std::size_t size, double dt, const double* by_velocity,
                         double* error) const;
  void add_energies(ChainState& m, double dt) const;
  struct Works {
    double supplied = 0, dissipated = 0, by_contacts = 0;
  };
  Works works_at(const ChainState& m, std::size_t j, double dt) const;  ///< those of the step at a site
  template <class Each>
  void for_sites(const Each& each) const;
  template <class Each>
  void for_groups(const Each& each) const;

  /// v' - v if friction is evaluated at the velocity w.
  double gain(std::size_t j, double w) const { return (w - from_->v[j] + shift_[j]) * per_weight_[j]; }
  double mean_velocity(std::size_t j) const { return from_->v[j] + gain(j, w_[j]) / 2; }
  double next_velocity(std::size_t j) const { return from_->v[j] + gain(j, w_[j]); }
  std::size_t sites() const { return w_.size(); }

  const SiteForces& forces_;
  const CompactSprings& springs_;
  const friction::Friction& friction_law_;
  int threads_;
  const ChainState* from_ = nullptr;
  SiteForces::Drives drives_;
  double rounding_ = 0;  ///< rounding error of the force on a site
  // These have an element for each site.
  std::vector<double> w_;  ///< velocity at which friction is evaluated
  Bordered per_weight_;    ///< w = v + (v' - v) / per_weight - shift
  std::vector<double> shift_;
  Bordered force_, slope_, middle_;                ///< all forces except springs, their slope in w; (u + u') / 2
  std::vector<double> friction_, friction_slope_;  ///< f, and its slope in w
  std::vector<double> forcing_, right_, errors_;
  Tridiagonal matrix_;
};

}  // namespace slipfront::chain
