#pragma once

#include <cstddef>
#include <vector>

#include "chain/implicit/moment.hpp"
#include "chain/implicit/site_forces.hpp"
#include "chain/implicit/tridiagonal.hpp"

namespace slipfront::chain {

/// A step of any length that is tried from a moment. With p = (v + v') / 2 the mean velocity of a step,
///     u' = u + dt p,    (v' - v) / dt + S + f - F = springs((u + u') / 2),    S = a^2 (cos u - cos u') / (u' - u):
/// this is the midpoint rule with a discrete gradient. Forces that have an energy neither give nor take any, whatever
/// dt, so work and energy balance to the residual of Newton's method. Friction acts at the state of the middle of the
/// step and at
///     w = p + (eta / 2)(v' - v - dt a),
/// with a the acceleration of the step before. The bracket is of second order, as the rule is. It damps the velocity
/// that the rule would leave at a site held by friction, and that would change its sign with every step. There eta is
/// 1/3; where friction is slow eta is 0. Where contacts change with the state, a^2 is the mean of its values at both
/// ends of the step, and the energy given to the substrate, (a'^2 - a^2)(1 - (cos u + cos u') / 2), is counted.
class ImplicitStep {
 public:
  /// Allocates all that its steps need. `forces` outlives it.
  ImplicitStep(const SiteForces& forces, int threads);

  /// Finds the velocities at the end of a step by Newton's method. Returns whether it has found them.
  bool solve(const Moment& from, double dt);
  /// The largest error of the step that was found, in tolerances: of u, u_t and the logarithm of the state variables.
  double error(const Moment& from, double dt);
  /// Takes the step that was found: `m`, from which it was tried, becomes its end, all but its time.
  void take(Moment& m, double dt) const;
  /// Of a step that was not found: the first site without a finite force, or else the fastest.
  std::size_t hardest_site() const;

 private:
  void prepare(const Moment& from, double dt);
  void evaluate(std::size_t j, double dt);
  double friction_at(std::size_t j, double w, double dt) const;
  double velocity_under_friction(std::size_t j, double change, double dt) const;
  void build_matrix(double dt);
  enum class Outcome { failed, improved, converged };
  Outcome correct(double dt);
  double error_at(std::size_t j, double dt) const;
  double creep_error(std::size_t j, double dt) const;
  double state_error(std::size_t j, double dt, double by_velocity) const;
  void add_energies(Moment& m, double dt) const;
  template <class Each>
  void for_sites(const Each& each) const;

  /// v' - v where friction feels w.
  double gain(std::size_t j, double w) const { return (w - from_->v[j] + shift_[j]) / weight_[j]; }
  double mean_velocity(std::size_t j) const { return from_->v[j] + gain(j, w_[j]) / 2; }
  double next_velocity(std::size_t j) const { return from_->v[j] + gain(j, w_[j]); }
  std::size_t sites() const { return w_.size(); }

  const SiteForces& forces_;
  const CompactSprings& springs_;
  const friction::Friction& friction_law_;
  [[maybe_unused]] int threads_;  ///< of OpenMP
  const Moment* from_ = nullptr;
  double rounding_ = 0;  ///< of the force on a site
  // Site by site.
  std::vector<double> w_;                          ///< velocity that friction feels
  std::vector<double> weight_, shift_;             ///< w = v + weight (v' - v) - shift
  std::vector<double> force_, slope_, middle_;     ///< all forces but the springs', their slope in w; (u + u') / 2
  std::vector<double> friction_, friction_slope_;  ///< f, and its slope in w
  std::vector<double> forcing_, right_, errors_;
  Tridiagonal matrix_;
};

}  // namespace slipfront::chain
