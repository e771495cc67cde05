#pragma once

#include <cstddef>
#include <vector>

#include "compact.hpp"
#include "slipfront/chain/chain.hpp"
#include "slipfront/chain/events.hpp"

namespace slipfront::chain {

/// A chain by implicit steps of any length. With p = (v + v') / 2 the mean velocity of a step,
///     u' = u + dt p,    (v' - v) / dt + S + f - F = springs((u + u') / 2),    S = a^2 (cos u - cos u') / (u' - u):
/// the midpoint rule with a discrete gradient. Forces that have an energy neither give nor take any, whatever dt, so
/// that work and energy balance to what Newton's method leaves. Friction acts at the memory of the middle and at
///     w = p + (eta / 2)(v' - v - dt a),
/// a the acceleration of the step before. What stands in brackets is of second order, as the rule is. It damps the
/// sign-changing velocity that the rule alone leaves at places that friction holds; eta is 1/3 there, and 0 where
/// friction is slow. Where contacts change with the state, a^2 is the mean of those at the ends of the step, and what
/// they give to the substrate, (a'^2 - a^2)(1 - (cos u + cos u') / 2), is counted. Steps follow an estimate of the
/// error in u, u_t and the logarithm of what places remember.
class ImplicitSteps {
 public:
  /// \throws InputError for what implicit steps cannot do: absorbing ends, friction that jumps at rest.
  ImplicitSteps(const Problem& problem, const Motion& start, int threads);

  /// At most `most` steps, to `until` and no farther. \throws NumericsError where no step is short enough.
  void advance(double until, long most);
  double time() const { return time_; }
  long steps() const { return steps_; }
  double last_step() const { return last_step_; }

  Window window(std::size_t from, std::size_t to) const;
  double forcing(std::size_t site) const;  ///< F and the pull of the springs, now
  double friction(std::size_t site, double velocity) const;
  double contact_squared(std::size_t site) const { return a2_.empty() ? all_contact_ : a2_[site]; }
  double elastic_energy() const { return springs_.energy(u_); }
  double loading_energy() const;  ///< in the springs that pull
  double supplied() const { return supplied_; }
  double dissipated() const { return dissipated_; }
  double by_contacts() const { return by_contacts_; }  ///< given to the substrate
  double effective_stress(std::size_t site) const { return contacts_.act() ? contacts_.share(excess_[site]) : 1; }
  const std::vector<double>& memory() const { return memory_; }
  const std::vector<Event>& events() const { return log_.events(); }

  /// All that it needs to go on, to the same bits. \throws InputError if the state does not fit.
  std::vector<double> saved() const;
  void resume(const std::vector<double>& saved);

 private:
  /// A step that is tried.
  struct Trial {
    std::vector<double> w, last_w, force, slope, theta, shift, friction, friction_slope, forcing, right;
  };
  /// v' - v where friction feels w.
  double gain(std::size_t j, double w) const { return (w - v_[j] + trial_.shift[j]) / trial_.theta[j]; }
  double pull(std::size_t site) const;  ///< stiffness, per length
  double mean_velocity(std::size_t j) const { return v_[j] + gain(j, trial_.w[j]) / 2; }
  double next_velocity(std::size_t j) const { return v_[j] + gain(j, trial_.w[j]); }
  /// A site's state and contact after a step, and 1 - p in its middle.
  struct Aged {
    double theta, excess, a2, share;
  };
  Aged aged(std::size_t j, double p, double dt) const;
  double friction_at(std::size_t j, double w, double dt) const;
  void check_contacts() const;
  void prepare(double dt);
  void evaluate(std::size_t j, double dt, int iteration);
  double friction_slope(std::size_t j, double w, double f, double dt, int iteration) const;
  bool solve(double dt);
  bool correct();
  double error_of(double dt) const;
  double memory_error(std::size_t j, double dt, double jerk) const;
  void accept(double dt);
  void look();
  template <class Each>
  void for_sites(const Each& each) const;

  Problem problem_;
  std::size_t n_, variables_;
  int threads_;
  bool rubs_;
  CompactSprings springs_;
  std::vector<double> a2_;
  double all_contact_ = 1;
  friction::Contacts contacts_;
  std::vector<double> base_;    ///< a^2 of contacts without age and pores without pressure
  std::vector<double> excess_;  ///< p - p_0
  std::vector<double> first_u_, u_, v_, memory_;
  std::vector<double> slope_;                   ///< of friction in the last step
  std::vector<double> acceleration_, earlier_;  ///< of the last two steps
  double last_step_ = 0, earlier_step_ = 0, next_step_;
  double time_ = 0;
  long steps_ = 0;
  double supplied_ = 0, dissipated_ = 0, by_contacts_ = 0;
  double rounding_ = 0;  ///< of the force on a site
  Trial trial_;
  Tridiagonal matrix_;
  std::size_t places_ = 1;
  EventLog log_;
};

}  // namespace slipfront::chain
