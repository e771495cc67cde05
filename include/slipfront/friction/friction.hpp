#pragma once
/// \file
/// The friction of a problem: a law, its numbers, and the closure of its average. Copied freely.

#include <memory>
#include <optional>
#include <string_view>
#include <vector>

#include "slipfront/friction/contacts.hpp"
#include "slipfront/friction/law.hpp"

namespace slipfront::friction {

class Friction {
 public:
  /// No friction.
  Friction();
  /// `values` are those of the definition's parameters, in their order; `curve` is for laws that take one.
  /// \throws InputError if there is a force although no parameter that is declared a force is > 0.
  Friction(const Definition& definition, std::vector<double> values, Closure closure = Closure::consistent,
           Curve curve = {});

  const Definition& definition() const { return *definition_; }
  std::string_view name() const { return definition_->name; }
  const Law& law() const { return *law_; }
  Closure closure() const { return closure_; }
  Friction with(Closure closure) const;
  /// Whether an average by this closure is defined: that of the paper knows no memory.
  bool defined_by(Closure closure) const { return closure == Closure::consistent || variables() == 0; }

  /// The value of a parameter; 0 if the law has none of that name.
  double parameter(std::string_view name) const;
  /// The same friction on a chain whose x and t are scaled up by `scale`.
  /// \throws InputError if the force does not scale, because a parameter of the law states a wrong Dimension.
  Friction scaled_by(double scale) const;
  /// \throws InputError for a parameter out of its range.
  void check() const;

  /// Whether there is any force.
  bool acts() const { return acts_; }
  /// C where f = C w (0 without friction). No other law has a coefficient C or a damping number C t.
  std::optional<double> linear_coefficient() const { return linear_; }
  /// Whether a place at rest can hold out against a force.
  bool sticks() const { return at_rest_ > 0; }
  /// The largest force that holds a place at rest at t = 0.
  double strength_at_rest() const { return at_rest_; }
  /// Whether f jumps or rises so steeply from rest that a step must end, not pass through, rest.
  bool steep_at_rest() const { return sticks() || law_->steep_at_rest(); }
  std::size_t variables() const { return definition_->variables.size(); }

  /// What the law's state does to contacts and pores; `act()` is false for most friction.
  const Contacts& contacts() const { return contacts_; }
  /// The contact ratio at t = 0 over that of contacts without age and pores without pressure. 1 for most friction.
  double contact_at_start() const;
  /// The largest factor by which a contact ratio may rise within a time, at slip velocities up to 10 c A / pi.
  double contact_growth(double time) const;

  /// f at the slip velocity w = `velocity`, with the sign of w.
  double force(double velocity, Memory memory = {}) const;
  /// The velocity that friction leaves of `free` in a time step: v + weight f(v) = free.
  double velocity_after(double free, double weight, Memory memory = {}) const;

  /// Loss of momentum per unit length, with the sign of U. Zero for the empty state.
  double momentum_loss(const State& state, double contact = 1, Memory memory = {}) const;
  double mean_strength(const State& state, double contact, Memory memory = {}) const {
    return law_->mean_strength(state, contact, closure_, memory);
  }
  std::unique_ptr<RelaxationRate> relaxation_rate() const { return law_->relaxation_rate(closure_); }

 private:
  const Definition* definition_;
  std::vector<double> values_;
  Curve curve_;
  Closure closure_ = Closure::consistent;
  std::shared_ptr<const Law> law_;
  Contacts contacts_;
  bool acts_ = false;
  std::optional<double> linear_;
  double at_rest_ = 0;
};

/// Laws by their numbers.
Friction viscous(double coefficient, Closure closure = Closure::consistent);
Friction coulomb(double coefficient, Closure closure = Closure::consistent);
Friction power(double coefficient, double exponent, Closure closure = Closure::consistent);

}  // namespace slipfront::friction
