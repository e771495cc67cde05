#pragma once

#include <vector>

#include "chain/explicit/contact_field.hpp"
#include "chain/explicit/levels/scheme.hpp"
#include "chain/explicit/levels/slab.hpp"

namespace slipfront::chain {

/// All forces on a site except springs, a substrate of strength 1 and viscous friction. A chain with forcing, other
/// friction or contacts that change advances by one level at a time, with `level`. Other chains can advance many levels
/// at a time.
class Forces {
 public:
  /// The forces on sites [begin, end) and on some more on either side. These continue around a periodic chain, and are
  /// reflected at the ends of other chains.
  Forces(const Problem& problem, const Scheme& scheme, long level, std::size_t begin, std::size_t end);

  bool by_level() const { return !F_now_.empty() || nonlinear_; }
  /// a(x)^2 from site j on; null if it is 1 everywhere.
  const double* a2(long j) const {
    return contacts_.acts() ? contacts_.now(j) : a2_.empty() ? nullptr : a2_.data() + at(j);
  }
  /// Contacts that change with the state of friction.
  const ContactField& contacts() const { return contacts_; }
  /// Arrays of F from site j on, at the present level, the level before and the next one. They are null without
  /// forcing.
  const double* F_now(long j) const { return F_now_.empty() ? nullptr : F_now_.data() + at(j); }
  const double* F_before(long j) const { return steady() ? F_now(j) : F_before_.data() + at(j); }
  const double* F_next(long j) const { return steady() ? F_now(j) : F_next_.data() + at(j); }
  /// F at site j at the present level, and its rate of change. Both are 0 without forcing.
  double now(long j) const { return F_now_.empty() ? 0.0 : F_now_[at(j)]; }
  double rate(long j) const { return steady() ? 0.0 : (F_next_[at(j)] - F_before_[at(j)]) / (2 * dt_); }

  /// Computes the next level of `size` sites, from site `offset` of the chain on. Arrays begin at that site. `now` and
  /// `before` also hold two neighbours on the left and ten on the right; `next` and `y` have room for them. If
  /// `applied` is not null, it gets the friction force on each site, for friction that is neither linear nor constant.
  void level(const EndConditions& ends, long offset, std::size_t size, const double* before, const double* now,
             double* next, double* y, Outflow& outflow, double* applied = nullptr) const;
  /// The work of such friction on `size` sites from site j on in a step D (radians). It uses the forces that were
  /// applied if the law acts on the half step, and otherwise the forces at the velocity of the step.
  double work_of_friction(long j, std::size_t size, const double* D, const double* applied) const;
  /// Energy, divided by the spacing, that contacts give to the substrate at `size` sites from site j on. The step D
  /// ends at u.
  double energy_of_contacts(long j, std::size_t size, const double* u, const double* D) const;
  /// (all) Gets what a level needs from the sites next to those of this rank.
  void exchange(const Ranks& ranks);
  /// (all) Gets everything of these sites, which windows need.
  void exchange_all(const Ranks& ranks);
  /// Moves to the next level.
  void proceed();
  /// Advances the state variables of `size` sites from site `first` on by the step from `now` to `next`.
  void age(long first, std::size_t size, const double* now, const double* next);
  /// The state variables of sites [begin, end), site by site. Most laws have none.
  std::vector<double> states(std::size_t begin, std::size_t end) const;
  void set_states(std::size_t begin, const std::vector<double>& states);
  /// How many numbers the state of a site has.
  std::size_t state_size() const { return variables_ + (contacts_.acts() ? ContactField::columns : 0); }
  /// Call this when the states of all sites are set.
  void resumed() {
    if (contacts_.acts()) contacts_.resumed();
  }

  /// The friction force on site j at velocity u_t.
  double friction(long j, double velocity) const {
    return (contacts_.acts() ? *contacts_.share(j) : 1.0) * problem_.friction.force(velocity, state(j));
  }
  /// Computes u from z, both in turns, for `size` sites from site j on.
  void displacements_from(long j, std::size_t size, const double* z, double* u) const;
  /// Computes the steps D and B (take_steps in kernel.hpp) of `size` sites from site j on. It sets u to its value at
  /// the next level. If contacts change, call `age` first.
  void steps_from(long j, std::size_t size, const double* before, const double* now, const double* next, double* u,
                  double* D, double* B) const;

 private:
  friction::LocalState state(long j) const {
    return variables_ == 0 ? friction::LocalState{} : friction::LocalState{state_of(j), variables_};
  }
  const double* state_of(long j) const { return state_.data() + variables_ * at(j); }
  double* state_of(long j) { return state_.data() + variables_ * at(j); }
  std::size_t at(long j) const { return static_cast<std::size_t>(j - first_); }
  void evaluate_forcing(long level, std::vector<double>& F) const;
  bool steady() const { return F_next_.empty(); }
  /// Adds friction to sites [begin, end) of arrays that begin at site `offset`.
  void add_friction(long offset, std::size_t begin, std::size_t end, const double* before, const double* now,
                    double* next, double* applied) const;
  void age_contacts(long first, std::size_t size, const double* velocity);
  friction::LocalStates states_from(long j) const {
    return variables_ == 0 ? friction::LocalStates{} : friction::LocalStates{state_of(j), variables_};
  }

  Problem problem_;
  Scheme scheme_;
  PeriodicForce sine_;
  double dt_;
  long level_;
  long first_, last_;          ///< the arrays hold sites [first_, last_)
  bool nonlinear_;             ///< there is friction other than C w, which the scheme itself contains
  std::size_t variables_;      ///< number of state variables of the friction law
  std::vector<double> state_;  ///< their values at each site
  std::vector<double> a2_;     ///< a^2; at t = 0 if it changes
  ContactField contacts_;
  std::vector<double> F_before_, F_now_, F_next_;  ///< only F_now_ is filled if F does not depend on t
};

}  // namespace slipfront::chain
