#pragma once

#include <vector>

#include "chain/explicit/contact_field.hpp"
#include "chain/explicit/levels/scheme.hpp"
#include "chain/explicit/levels/slab.hpp"

namespace slipfront::chain {

/// All forces on a site but springs, a substrate of strength 1 and viscous friction. A chain without them can
/// advance many levels at a time; a chain with them advances level by level, through here.
class Forces {
 public:
  /// Sites by which arrays extend past both ends. A window of a few sites there needs them.
  static constexpr std::size_t margin = 16;

  /// On sites [begin, end), and `margin` more: around a periodic chain, reflected at the ends of others.
  Forces(const Problem& problem, const Scheme& scheme, long level, std::size_t begin, std::size_t end);

  bool none() const { return a2_.empty() && F_now_.empty() && !nonlinear_; }
  /// a(x)^2 from site j on; null where it is 1.
  const double* a2(long j) const {
    return contacts_.acts() ? contacts_.now(j) : a2_.empty() ? nullptr : a2_.data() + at(j);
  }
  /// Contacts that change with the state of friction.
  const ContactField& contacts() const { return contacts_; }
  /// F at site j now, at the level before and at the next one; arrays from site j on, null where there is no forcing.
  const double* F_now(long j) const { return F_now_.empty() ? nullptr : F_now_.data() + at(j); }
  const double* F_before(long j) const { return steady() ? F_now(j) : F_before_.data() + at(j); }
  const double* F_next(long j) const { return steady() ? F_now(j) : F_next_.data() + at(j); }
  /// F at site j now, and its rate of change. 0 where there is none.
  double now(long j) const { return F_now_.empty() ? 0.0 : F_now_[at(j)]; }
  double rate(long j) const { return steady() ? 0.0 : (F_next_[at(j)] - F_before_[at(j)]) / (2 * dt_); }

  /// One level of `size` sites, the first of which is site `offset` of the chain; arrays count from it. `now` and
  /// `before` have two neighbours on the left and ten on the right; `next` and `y` have room for them. `applied`,
  /// unless null, gets the force by which friction that is neither linear nor constant has slowed each site.
  void level(const EndConditions& ends, long offset, std::size_t size, const double* before, const double* now,
             double* next, double* y, Outflow& outflow, double* applied = nullptr) const;
  /// The work of such friction on `size` sites from site j on in a step D, in radians: by the forces that were applied
  /// if those act over the step, otherwise by those at its velocity.
  double work_of_friction(long j, std::size_t size, const double* D, const double* applied) const;
  /// Energy per spacing that contacts give to the substrate at `size` sites from site j on in a step D to u.
  double energy_of_contacts(long j, std::size_t size, const double* u, const double* D) const;
  /// To the next level of the forcing.
  void proceed();
  /// Changes the friction law's variables of `size` sites from site `first` on, over the step from `now` to `next`.
  void age(long first, std::size_t size, const double* now, const double* next);
  /// The same variables of sites [begin, end), site by site; none for most laws.
  std::vector<double> states(std::size_t begin, std::size_t end) const;
  void set_states(std::size_t begin, const std::vector<double>& states);
  /// Numbers in the state of a site.
  std::size_t state_size() const { return variables_ + (contacts_.acts() ? ContactField::columns : 0); }
  /// To be called when the states of all sites are set.
  void resumed() {
    if (contacts_.acts()) contacts_.resumed();
  }

  /// The friction force on site j at velocity u_t.
  double friction(long j, double velocity) const {
    return (contacts_.acts() ? *contacts_.share(j) : 1.0) * problem_.friction.force(velocity, state(j));
  }
  /// u from z, both in turns, of `size` sites from site j on; `S` is room for work.
  void displacements_from(long j, std::size_t size, const double* z, double* u, double* S) const;
  /// Steps D, B (kernel's take_steps) of `size` sites from site j on, u then being that of the next level, to which
  /// `age` has taken contacts that change; `u_next` and `S` are room for work.
  void steps_from(long j, std::size_t size, const double* before, const double* now, const double* next, double* u,
                  double* D, double* B, double* u_next, double* S) const;

 private:
  friction::LocalState state(long j) const {
    return variables_ == 0 ? friction::LocalState{} : friction::LocalState{state_of(j), variables_};
  }
  const double* state_of(long j) const;
  std::size_t at(long j) const { return static_cast<std::size_t>(j - first_); }
  void evaluate_forcing(long level, std::vector<double>& F) const;
  bool steady() const { return F_next_.empty(); }
  /// On sites [begin, end) of a level that begins with site `offset`.
  void add_friction(long offset, std::size_t begin, std::size_t end, const double* before, const double* now,
                    double* next, double* applied) const;
  void age_contacts(long first, std::size_t size, const double* velocity);
  /// The states of `size` sites from site j on; those past an end are copied into `room`.
  friction::LocalStates states_from(long j, std::size_t size, std::vector<double>& room) const;

  Problem problem_;
  Scheme scheme_;
  PeriodicForce sine_;
  double dt_;
  long level_;
  long first_, last_;          ///< sites of the arrays' first element and behind their last
  bool nonlinear_;             ///< there is friction other than C w, which the scheme itself has
  std::size_t variables_;      ///< of the friction law
  std::vector<double> state_;  ///< their values at each site of the chain, which one rank has alone then
  std::vector<double> a2_;     ///< at t = 0 if it changes
  ContactField contacts_;
  std::vector<double> F_before_, F_now_, F_next_;  ///< F_now_ alone where it does not depend on t
};

}  // namespace slipfront::chain
