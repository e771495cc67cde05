#include "slipfront/events/inference/quantities.hpp"

#include <cmath>
#include <limits>
#include <vector>

#include "slipfront/theory/medium/medium.hpp"

namespace slipfront::inference {
namespace {

using Role = Quantity::Role;

/// The members with this name in a state, an estimate and a posterior.
#define MEMBER(name)                                                               \
  &FaultQuantities<double>::name, &FaultQuantities<std::optional<Inferred>>::name, \
      &FaultQuantities<std::optional<Quantiles>>::name

// The first four entries are name, long name, unit to multiply by, and equation. Then follow the long name in the
// result of an event, the role, whether the posterior shows it, the members, and the axis label.
constexpr Quantity declarations[] = {
    {{"rupture_velocity_m_s", "rupture velocity, in m/s", "", "Eqs. 8-10", {}, {}, "m s-1"},
     "",
     Role::sample,
     true,
     MEMBER(rupture_velocity_m_s)},
    {{"rupture_velocity", "rupture velocity", "c", "Eqs. 8-10"},
     "",
     Role::closed_form,
     false,
     MEMBER(rupture_velocity),
     "rupture velocity"},
    {{"characteristic_velocity", "|V-|, speed of the first disturbance", "c", "Eqs. 8-10"},
     "",
     Role::friction,
     true,
     MEMBER(characteristic_velocity),
     "|V−| / c"},
    {{"stress", "Sigma-, stress before the rupture", "mu A / pi", "Eqs. 8-10"},
     "",
     Role::closed_form,
     true,
     MEMBER(stress),
     "initial stress Σ−"},
    {{"frictionless_slip_velocity", "slip velocity W(0) without friction", "c A / pi", "Eqs. 8-10"},
     "",
     Role::closed_form,
     false,
     MEMBER(frictionless_slip_velocity)},
    {{"observed_slip_velocity", "observed slip velocity", "c A / pi", "Eqs. 8-10"},
     "observed slip velocity; needs an observed contact ratio",
     Role::closed_form,
     false,
     MEMBER(observed_slip_velocity)},
    {{"slip_velocity_ratio", "observed over frictionless slip velocity", "", "Eqs. 8-10"},
     "",
     Role::closed_form,
     false,
     MEMBER(slip_velocity_ratio)},
    {{"contact_ratio", "A, real to nominal contact area", "", "Eq. 1"},
     "A, real to nominal contact area: observed, or inferred without friction",
     Role::closed_form,
     true,
     MEMBER(contact_ratio),
     "contact ratio A"},
    {{"damping_number", "Gamma = C T", "", "Eq. 7"},
     "Gamma = C T; needs friction",
     Role::friction,
     true,
     MEMBER(damping_number),
     "damping number Γ"},
    {{"friction_coefficient", "C of viscous friction", "", "Eq. 7"},
     "",
     Role::friction,
     true,
     MEMBER(friction_coefficient)},
    {{"stress_pa", "stress before the rupture, in Pa", "", "Eqs. 8-10", {}, {}, "Pa"},
     "stress before the rupture, in Pa; absent if only a bound is known",
     Role::closed_form,
     true,
     MEMBER(stress_pa)},
    {{"static_drop_pa", "stress before minus stress after at x = 0, in Pa", "", "Eqs. 8-10", {}, {}, "Pa"},
     "",
     Role::friction,
     true,
     MEMBER(static_drop_pa)},
    {{"stress_bound", "lower bound of Sigma-, without friction", "mu A / pi", "Eqs. 8-10"},
     "",
     Role::lower_bound,
     false,
     MEMBER(stress_bound)},
    {{"contact_ratio_bound", "lower bound of A, without friction", "", "Eq. 1"},
     "",
     Role::lower_bound,
     false,
     MEMBER(contact_ratio_bound)},
    {{"stress_pa_bound",
      "lower bound of the stress before the rupture, in Pa, without friction",
      "",
      "Eqs. 8-10",
      {},
      {},
      "Pa"},
     "",
     Role::lower_bound,
     false,
     MEMBER(stress_pa_bound)},
};
#undef MEMBER

/// The quantities with these roles, one role after the other, with their long names in the result of an event.
std::vector<Quantity> of_roles(std::initializer_list<Role> roles) {
  std::vector<Quantity> chosen;
  for (const Role role : roles)
    for (Quantity q : declarations) {
      if (q.role != role) continue;
      if (!q.answer.empty()) q.about.long_name = q.answer;
      chosen.push_back(q);
    }
  return chosen;
}

}  // namespace

std::span<const Quantity> quantities() { return declarations; }

std::span<const Quantity> answer_quantities() {
  static const std::vector<Quantity> chosen = of_roles({Role::closed_form, Role::friction});
  return chosen;
}

std::span<const Quantity> bound_quantities() {
  static const std::vector<Quantity> chosen = of_roles({Role::lower_bound});
  return chosen;
}

std::span<const Quantity> posterior_quantities() {
  static const std::vector<Quantity> chosen = [] {
    std::vector<Quantity> all;
    for (const Quantity& q : declarations)
      if (q.in_posterior) all.push_back(q);
    return all;
  }();
  return chosen;
}

FaultState unknown_state() {
  FaultState state;
  for (const Quantity& q : declarations) state.*q.state = std::numeric_limits<double>::quiet_NaN();
  return state;
}

void derive(FaultState& s, const medium::Elastic& elastic, std::optional<double> slip_velocity) {
  if (slip_velocity && !std::isnan(s.contact_ratio)) {
    s.observed_slip_velocity = *slip_velocity / medium::slip_velocity_unit(elastic.speed, s.contact_ratio);
    s.slip_velocity_ratio = s.observed_slip_velocity / s.frictionless_slip_velocity;
  }
  const double least_stress = std::isnan(s.stress) ? s.stress_bound : s.stress;
  if (!std::isnan(s.contact_ratio))
    s.stress_pa = medium::stress_unit(elastic.shear_modulus, s.contact_ratio) * s.stress;
  if (!std::isnan(s.contact_ratio_bound))
    s.stress_pa_bound = medium::stress_unit(elastic.shear_modulus, s.contact_ratio_bound) * least_stress;
  else if (!std::isnan(s.stress_bound))
    s.stress_pa_bound = medium::stress_unit(elastic.shear_modulus, s.contact_ratio) * s.stress_bound;
}

}  // namespace slipfront::inference
