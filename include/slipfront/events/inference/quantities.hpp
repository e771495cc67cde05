#pragma once
/// \file
/// The quantities of a fault's state. Each is declared once; files, tables, Python and figures use these declarations.

#include <optional>
#include <span>
#include <string_view>

#include "slipfront/description.hpp"
#include "slipfront/events/catalogue/measured.hpp"
#include "slipfront/theory/medium/constants.hpp"

namespace slipfront::inference {

using catalogue::Quantiles;

/// The 5 % and 95 % quantiles of an inferred quantity.
struct Interval {
  double low;
  double high;
};

/// An inferred number. The closed forms give an `interval` only if exactly one observational error changes the number
/// (a range counts as a uniform distribution). Every inferred quantity is monotone in each observed one, so its
/// quantiles follow exactly from those of the observed one. For an event that is sampled, see EventResult.
struct Inferred {
  double value;
  std::optional<Interval> interval;
};

/// One value of each quantity: a number in a state, an inferred number in an estimate, quantiles in a posterior.
template <class T>
struct FaultQuantities {
  T rupture_velocity_m_s{};        ///< V, m/s
  T rupture_velocity{};            ///< observed rupture velocity over c
  T characteristic_velocity{};     ///< |V-| / c; the same, unless an observer saw the front fall behind
  T stress{};                      ///< Sigma-, in mu A / pi
  T frictionless_slip_velocity{};  ///< W(0) without friction, in c A / pi
  T observed_slip_velocity{};      ///< in c A / pi; needs an observed contact ratio, not an inferred one
  T slip_velocity_ratio{};         ///< observed over frictionless; friction reduces it by 1 - ratio
  T contact_ratio{};               ///< A: given, or pi w / (c W(0)) as if there were no friction
  T damping_number{};              ///< Gamma = C T; needs the posterior, like the next
  T friction_coefficient{};        ///< C
  T stress_pa{};                   ///< mu A Sigma- / pi, Pa; absent if only a bound is known
  T static_drop_pa{};              ///< stress before minus stress after at x = 0, Pa; needs the posterior
  /// Lower bounds: the values without friction. A and the stress in Pa have bounds if only velocities are known. Both
  /// stresses have bounds if a contact ratio is known but no rupture velocity.
  T stress_bound{}, contact_ratio_bound{}, stress_pa_bound{};
};

/// One state of the fault. A quantity is NaN if the observations do not determine it.
using FaultState = FaultQuantities<double>;
using InferredQuantities = FaultQuantities<std::optional<Inferred>>;
using QuantileQuantities = FaultQuantities<std::optional<Quantiles>>;

/// A quantity and its members in a state, in an estimate and in a posterior.
struct Quantity {
  /// The source of a quantity in the result of an event.
  enum class Role {
    sample,       ///< not in the result; only the samples have it
    closed_form,  ///< from the closed forms or from samples
    friction,     ///< from samples, if friction is known
    lower_bound,  ///< a lower bound, the value without friction
  };
  Description about;
  std::string_view answer;  ///< long name in the result of an event; empty: that of `about`
  Role role;
  bool in_posterior;  ///< also shown as a quantity of the posterior
  double FaultState::*state;
  std::optional<Inferred> InferredQuantities::*inferred;
  std::optional<Quantiles> QuantileQuantities::*quantiles;
  std::string_view label = {};  ///< short name on the axis of a figure; empty: the long name
};

/// All quantities.
std::span<const Quantity> quantities();
/// The quantities in the result of an event, in the order of output: closed forms, then friction.
std::span<const Quantity> answer_quantities();
/// The lower bounds in the result of an event.
std::span<const Quantity> bound_quantities();
/// The quantities that are shown for the posterior, in addition to the result.
std::span<const Quantity> posterior_quantities();

/// A state in which every quantity is NaN.
FaultState unknown_state();
/// Computes the quantities of a state that follow from its other quantities. `slip_velocity` (m/s) must be absent if
/// the contact ratio was inferred from it.
void derive(FaultState& state, const medium::Elastic& elastic, std::optional<double> slip_velocity);

}  // namespace slipfront::inference
