#pragma once
/// \file
/// The friction of a problem: a law, its parameters, which may vary along the interface, and the closure of its
/// average. Copies are cheap.

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "slipfront/friction/law.hpp"

namespace slipfront::friction {

struct Contacts;

/// A parameter that varies: its value at a position, in the unit of the model, and the range of its values. y is 0 on a
/// line.
struct AlongInterface {
  std::function<double(double x, double y)> at;
  double least, most;
};

class Friction {
 public:
  /// No friction.
  Friction();
  /// `values` are those of the definition's parameters, in their order. `curve` is for laws that take one.
  /// \throws InputError if the law has a force although no parameter with Dimension::force is > 0.
  Friction(const Definition& definition, std::vector<double> values, Closure closure = Closure::consistent,
           Curve curve = {});

  const Definition& definition() const { return *definition_; }
  std::string_view name() const { return definition_->name; }
  const Law& law() const { return *law_; }
  const ForceLoops& loops() const { return law_->loops(); }
  const TrainAverage& average() const { return law_->average(); }
  const StateEvolution& evolution() const { return law_->evolution(); }
  Closure closure() const { return closure_; }
  Friction with(Closure closure) const;
  /// This friction with another value of a parameter.
  Friction with(std::string_view parameter, double value) const;
  /// This friction with a parameter that varies. `parameter` then returns its largest value.
  Friction with(std::string_view parameter, const AlongInterface& value) const;
  /// This friction with a normal stress that varies, as a share of the one that the parameters assume. All forces are
  /// proportional to it.
  Friction under(const AlongInterface& share) const;
  /// The uniform friction with the parameters and the normal stress of a position.
  Friction at(double x, double y) const;
  /// Whether a parameter or the normal stress varies.
  bool varies() const { return !columns_.empty(); }
  /// Whether an average by this closure is defined. The paper's closure is undefined for laws with state variables.
  bool defined_by(Closure closure) const { return closure == Closure::consistent || definition_->state.empty(); }

  /// The value of a parameter, or its largest value if it varies; 0 if the law has no parameter of that name.
  double parameter(std::string_view name) const;
  /// This friction on a chain whose x and t are scaled up by `scale`.
  /// \throws InputError if the force does not scale, because a parameter of the law has a wrong Dimension.
  Friction scaled_by(double scale) const;

  /// Whether there is any force.
  bool acts() const { return acts_; }
  /// C of the law f = C w (0 without friction). Other laws, and a C that varies, have none, and no damping number C t.
  std::optional<double> linear_coefficient() const { return law_->facts().linear_coefficient; }
  /// Whether there is a force f = C w, also with a C that varies.
  bool is_viscous() const { return acts_ && linear_; }
  /// C of the law f = C w at a position, also of a C that varies.
  std::optional<double> linear_coefficient(double x, double y) const;
  /// f_0 of the law f = f_0 sign(w).
  std::optional<double> constant_strength() const { return law_->facts().constant_strength; }
  /// C of the law f = C w^2 sign(w).
  std::optional<double> square_coefficient() const { return law_->facts().square_coefficient; }
  /// Whether a position at rest can withstand a force.
  bool sticks() const { return at_rest_ > 0; }
  /// The largest force that holds a position at rest at t = 0.
  double strength_at_rest() const { return at_rest_; }
  /// Whether f jumps or rises so steeply from rest that a time step must end at rest instead of reversing the slip.
  bool steep_at_rest() const { return sticks() || law_->facts().steep_at_rest; }
  /// Number of values that the friction of a position depends on and that solvers keep: the state variables of the law,
  /// and its parameters that vary.
  std::size_t state_size() const { return definition_->state.size() + columns_.size(); }
  /// Whether any of them change. Parameters that vary do not.
  bool state_evolves() const { return !definition_->state.empty(); }
  /// Their names.
  std::vector<std::string> state_names() const;
  /// Sets these values at a position at t = 0.
  void start(double x, double y, std::span<double> state) const;
  /// These values at t = 0 where the parameters that vary are largest.
  std::vector<double> state_at_start() const;

  /// The effect of the law's state on contacts and pores (friction/state/contacts.hpp). Of numbers that vary it has the
  /// largest.
  const Contacts& contacts() const { return *contacts_; }
  /// That at a position, whose numbers `state` has.
  Contacts contacts_at(LocalState state) const;
  /// Whether numbers of contacts or pores vary.
  bool contacts_vary() const { return !contact_columns_.empty(); }
  /// Whether the state changes contacts or pores. It does not for most laws.
  bool changes_contacts() const;
  /// The contact ratio at t = 0 over that of contacts without age and pores without pressure, at a position. It is 1
  /// for most laws.
  double contact_at_start(double x) const;
  /// The largest factor by which a contact ratio may rise within a time, at slip velocities up to 10 c A / pi.
  double contact_growth(double time) const;

  /// f at the slip velocity w = `velocity`, with the sign of w.
  double force(double velocity, LocalState state = {}) const;
  /// The velocity v at the end of an implicit time step, v + weight f(v) = free. `free` is the velocity without
  /// friction.
  double velocity_after(double free, double weight, LocalState state = {}) const;

  /// Loss of momentum per unit length, with the sign of U. Zero for the empty state.
  double momentum_loss(const State& train, double contact = 1, LocalState state = {}) const;
  double mean_strength(const State& train, double contact, LocalState state = {}) const {
    return average().mean_strength(train, contact, closure_, state);
  }
  std::unique_ptr<RelaxationRate> relaxation_rate() const { return average().relaxation_rate(closure_); }

 private:
  /// The name "normal_stress" stands for the share of the normal stress.
  using Variations = std::map<std::string, AlongInterface, std::less<>>;
  Friction(const Definition& definition, std::vector<double> values, Closure closure, Curve curve, Variations varying);
  std::pair<double, double> range_of(std::string_view parameter) const;
  std::pair<double, double> ages_at_start() const;

  const Definition* definition_;
  std::vector<double> values_;
  Variations varying_;
  /// The values of a position besides the state variables of the law: parameters, and last a share of the force.
  std::vector<AlongInterface> columns_;
  std::vector<std::string> column_names_;
  std::optional<double> linear_;  ///< C of the law f = C w where the share of the force is 1
  Curve curve_;
  Closure closure_ = Closure::consistent;
  std::shared_ptr<const Law> law_;
  std::shared_ptr<const Contacts> contacts_;
  std::vector<std::pair<double Contacts::*, std::size_t>>
      contact_columns_;  ///< numbers that vary: where states have them
  bool acts_ = false;
  double at_rest_ = 0;
};

/// The laws f = C w, f = C sign(w) and f = C |w|^(n-1) w, from their parameters.
Friction viscous(double coefficient, Closure closure = Closure::consistent);
Friction coulomb(double coefficient, Closure closure = Closure::consistent);
Friction power(double coefficient, double exponent, Closure closure = Closure::consistent);

}  // namespace slipfront::friction
