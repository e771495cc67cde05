#pragma once
/// \file
/// The quantities of a fault's state, each declared once: files, tables, Python and figures read the declarations.

#include <optional>
#include <span>
#include <string_view>

#include "slipfront/catalogue/measured.hpp"
#include "slipfront/description.hpp"
#include "slipfront/medium/constants.hpp"

namespace slipfront::inference {

using catalogue::Quantiles;

/// [5 %, 95 %] of an inferred quantity.
struct Interval {
  double low;
  double high;
};

/// An inferred number. By the closed forms `interval` is there when exactly one observed error moves it (a range is
/// read as uniform): every inferred quantity is monotone in each observed one, so its quantiles are those of the
/// observed one, exactly. Where the event is sampled, see EventResult.
struct Inferred {
  double value;
  std::optional<Interval> interval;
};

/// One value of each quantity: a number of a state, an inferred number of an estimate, quantiles of a posterior.
template <class T>
struct FaultQuantities {
  T rupture_velocity_m_s{};        ///< V, m/s
  T rupture_velocity{};            ///< V / c
  T stress{};                      ///< Sigma-, in mu A / pi
  T frictionless_slip_velocity{};  ///< W(0) without friction, in c A / pi
  T observed_slip_velocity{};      ///< in c A / pi; needs a contact ratio that is given, not inferred
  T slip_velocity_ratio{};         ///< observed over frictionless; 1 - ratio is what friction took
  T contact_ratio{};               ///< A: given, or pi w / (c W(0)) as if there were no friction
  T damping_number{};              ///< Gamma = C T; needs the posterior, like the next
  T friction_coefficient{};        ///< C
  T stress_pa{};                   ///< mu A Sigma- / pi, Pa; absent where only a bound is known
  /// Lower bounds, if friction took nothing: of A and the stress in Pa where only velocities are known, of both
  /// stresses where there is a contact ratio and no rupture velocity.
  T stress_bound{}, contact_ratio_bound{}, stress_pa_bound{};
};

/// One state of the fault; NaN where the observations do not identify a quantity.
using FaultState = FaultQuantities<double>;

/// A quantity and where it stands in a state, in an estimate and in a posterior.
struct Quantity {
  /// Where an event's answer has it.
  enum class Role {
    sample,       ///< nowhere: samples alone have it
    closed_form,  ///< from the closed forms or from samples
    friction,     ///< from samples, where friction is known
    lower_bound,  ///< a lower bound, if friction took nothing
  };
  Description about;
  std::string_view answer;  ///< long name in an event's answer; empty: that of `about`
  Role role;
  bool in_posterior;  ///< shown as a quantity of the posterior too
  double FaultState::*state;
  std::optional<Inferred> FaultQuantities<std::optional<Inferred>>::*inferred;
  std::optional<Quantiles> FaultQuantities<std::optional<Quantiles>>::*quantiles;
  std::string_view label = {};  ///< short name on the axis of a figure; empty: the long name
};

/// All of them.
std::span<const Quantity> quantities();
/// Those of an event's answer, in the order of output: closed forms, friction.
std::span<const Quantity> answer_quantities();
/// Those of an event's answer that are lower bounds.
std::span<const Quantity> bound_quantities();
/// Those that the posterior shows beside the answer.
std::span<const Quantity> posterior_quantities();

/// A state of which nothing is known yet.
FaultState unknown_state();
/// Computes the quantities that follow from the others of a state. `slip_velocity` (m/s) is absent where the contact
/// ratio was inferred from it.
void derive(FaultState& state, const medium::Elastic& elastic, std::optional<double> slip_velocity);

}  // namespace slipfront::inference
