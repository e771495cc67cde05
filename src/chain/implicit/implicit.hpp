#pragma once

#include <cstddef>
#include <vector>

#include "chain/implicit/compact.hpp"
#include "slipfront/chain/chain.hpp"
#include "slipfront/chain/events.hpp"

namespace slipfront::chain {

/// Advances a chain by implicit steps of any length. With p = (v + v') / 2 the mean velocity of a step,
///     u' = u + dt p,    (v' - v) / dt + S + f - F = springs((u + u') / 2),    S = a^2 (cos u - cos u') / (u' - u):
/// this is the midpoint rule with a discrete gradient. Forces that have an energy neither give nor take any, whatever
/// dt, so work and energy balance to the residual of Newton's method. Friction acts at the state of the middle of the
/// step and at
///     w = p + (eta / 2)(v' - v - dt a),
/// with a the acceleration of the step before. The bracket is of second order, as the rule is. It damps the velocity
/// that the rule would leave at a site held by friction, and that would change its sign with every step. There eta is
/// 1/3; where friction is slow eta is 0. Where contacts change with the state, a^2 is the mean of its values at both
/// ends of the step, and the energy given to the substrate, (a'^2 - a^2)(1 - (cos u + cos u') / 2), is counted. The
/// length of a step follows an estimate of its error in u, u_t and the logarithm of the state variables.
///
/// Steps do not depend on the times at which the motion is asked for. A step that passes such a time is kept, and a
/// second, shorter step from the same start gives the motion at that time; it is only shown.
class ImplicitSteps {
 public:
  /// \throws InputError for conditions that implicit steps do not support: absorbing ends, friction that jumps at rest.
  ImplicitSteps(const Problem& problem, const Motion& start, int threads);

  /// Takes at most `most` steps and does not pass `until`. \throws NumericsError where no step is short enough.
  void advance(double until, long most);
  double time() const { return now_.time; }
  long steps() const { return now_.steps; }
  double last_step() const { return now_.last_step; }

  Window window(std::size_t from, std::size_t to) const;
  double forcing(std::size_t site) const;  ///< F and the pull of the springs, now
  double friction(std::size_t site, double velocity) const;
  double contact_squared(std::size_t site) const { return now_.a2.empty() ? all_contact_ : now_.a2[site]; }
  double elastic_energy() const { return springs_.energy(now_.u); }
  double loading_energy() const;  ///< in the springs that pull
  double supplied() const { return now_.supplied; }
  double dissipated() const { return now_.dissipated; }
  double by_contacts() const { return now_.by_contacts; }  ///< given to the substrate
  double effective_stress(std::size_t site) const { return contacts_.act() ? contacts_.share(now_.excess[site]) : 1; }
  const std::vector<double>& memory() const { return now_.memory; }
  const std::vector<Event>& events() const { return now_.log.events(); }

  /// All that is needed to continue to the same bits. \throws InputError if the saved values do not fit the problem.
  std::vector<double> saved() const;
  void resume(const std::vector<double>& saved);

 private:
  /// The motion between two steps, with all that the next step depends on.
  struct Moment {
    double time = 0;
    long steps = 0;
    double last_step = 0, earlier_step = 0, next_step = 0;
    double window_start = 0;  ///< time at which the present window of check_progress() began
    double supplied = 0, dissipated = 0, by_contacts = 0;
    std::vector<double> u, v, memory;
    std::vector<double> w, slope;  ///< velocity that friction felt in the last step, slope of friction there
    std::vector<double> acceleration, earlier;  ///< of the last two steps
    std::vector<double> excess;                 ///< p - p_0 of the pores; empty unless contacts change
    std::vector<double> a2;                     ///< empty where a is the same everywhere
    EventLog log;
  };
  /// A step that is tried.
  struct Trial {
    std::vector<double> w, force, slope, theta, shift, friction, friction_slope, forcing, right, middle;
  };
  /// v' - v where friction feels w.
  double gain(std::size_t j, double w) const { return (w - now_.v[j] + trial_.shift[j]) / trial_.theta[j]; }
  double pull(std::size_t site) const;  ///< stiffness, per length
  double mean_velocity(std::size_t j) const { return now_.v[j] + gain(j, trial_.w[j]) / 2; }
  double next_velocity(std::size_t j) const { return now_.v[j] + gain(j, trial_.w[j]); }
  /// A site's state and contact after a step, and 1 - p in its middle.
  struct Aged {
    double theta, excess, a2, share;
  };
  Aged aged(std::size_t j, double p, double dt) const;
  double friction_at(std::size_t j, double w, double dt) const;
  double friction_slope(std::size_t j, double w, double f, double dt) const;
  double velocity_under_friction(std::size_t j, double change, double dt) const;
  void start_contacts();
  void strengthen_contacts();
  void check_contacts() const;
  void check_progress();
  void prepare(double dt);
  void evaluate(std::size_t j, double dt);
  void build_matrix(double dt);
  bool solve(double dt);
  bool correct(double dt);
  double error_of(double dt) const;
  double creep_error(std::size_t j, double dt) const;
  double memory_error(std::size_t j, double dt, double by_velocity) const;
  void accept(double dt);
  void step();
  void step_to(double time);
  [[noreturn]] void give_up() const;
  void look();
  template <class Each>
  void for_sites(const Each& each) const;

  Problem problem_;
  std::size_t n_, variables_;
  int threads_;
  bool rubs_;
  CompactSprings springs_;
  double all_contact_ = 1;
  friction::Contacts contacts_;
  std::vector<double> base_;  ///< a^2 of contacts without age and pores without pressure
  std::vector<double> first_u_;
  double rounding_ = 0;  ///< of the force on a site
  Moment now_;
  /// The step that has passed the time of `now_`: its start and its end, if there is one.
  Moment before_, after_;
  bool passed_ = false;
  Trial trial_;
  Tridiagonal matrix_;
  std::size_t places_ = 1;

  static constexpr double smallest_velocity = 1e-290;  ///< far below that of any interface at rest
};

}  // namespace slipfront::chain
