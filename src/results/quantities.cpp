#include "slipfront/results/quantities.hpp"

#include <limits>

namespace slipfront::results {

using inference::Estimate;
using inference::Inferred;
using inference::Posterior;

std::span<const EstimateQuantity<double>> measured_quantities() {
  static constexpr EstimateQuantity<double> quantities[] = {
      {{"rupture_velocity_m_s", "observed rupture velocity, in m/s", "", "Section 4"},
       &Estimate::observed_rupture_velocity},
      {{"slip_velocity_m_s", "observed slip velocity, in m/s", "", "Section 4"}, &Estimate::observed_slip_velocity_m_s},
  };
  return quantities;
}

std::span<const EstimateQuantity<Inferred>> inferred_quantities() {
  static constexpr EstimateQuantity<Inferred> quantities[] = {
      {{"rupture_velocity", "rupture velocity", "c", "Eqs. 8-10"}, &Estimate::rupture_velocity},
      {{"stress", "Sigma-, stress before the rupture", "mu A / pi", "Eqs. 8-10"}, &Estimate::stress},
      {{"frictionless_slip_velocity", "slip velocity W(0) as if there were no friction", "c A / pi", "Eqs. 8-10"},
       &Estimate::frictionless_slip_velocity},
      {{"observed_slip_velocity", "observed slip velocity; needs a contact ratio that is given", "c A / pi",
        "Eqs. 8-10"},
       &Estimate::observed_slip_velocity},
      {{"slip_velocity_ratio", "observed over frictionless slip velocity", "", "Eqs. 8-10"},
       &Estimate::slip_velocity_ratio},
      {{"contact_ratio", "A, real to nominal contact area: given, or as if there were no friction", "", "Eq. 1"},
       &Estimate::contact_ratio},
      {{"stress_pa", "stress before the rupture, in Pa; none where only a bound is known", "", "Eqs. 8-10"},
       &Estimate::stress_pa},
      {{"damping_number", "Gamma = C T; needs friction", "", "Eq. 7"}, &Estimate::damping_number},
      {{"friction_coefficient", "C of viscous friction", "", "Eq. 7"}, &Estimate::friction_coefficient},
  };
  return quantities;
}

std::span<const EstimateQuantity<Inferred>> bound_quantities() {
  static constexpr EstimateQuantity<Inferred> quantities[] = {
      {{"stress_bound", "least Sigma-, if friction took nothing", "mu A / pi", "Eqs. 8-10"}, &Estimate::stress_bound},
      {{"contact_ratio_bound", "least A, if friction took nothing", "", "Eq. 1"}, &Estimate::contact_ratio_bound},
      {{"stress_pa_bound", "least stress before the rupture, in Pa, if friction took nothing", "", "Eqs. 8-10"},
       &Estimate::stress_pa_bound},
  };
  return quantities;
}

std::span<const PosteriorQuantity> posterior_quantities() {
  static constexpr PosteriorQuantity quantities[] = {
      {{"rupture_velocity_m_s", "rupture velocity, in m/s", "", "Eqs. 8-10"}, &Posterior::rupture_velocity_m_s},
      {{"stress", "Sigma-, stress before the rupture", "mu A / pi", "Eqs. 8-10"}, &Posterior::stress},
      {{"contact_ratio", "A, real to nominal contact area", "", "Eq. 1"}, &Posterior::contact_ratio},
      {{"damping_number", "Gamma = C T", "", "Eq. 7"}, &Posterior::damping_number},
      {{"friction_coefficient", "C of viscous friction", "", "Eq. 7"}, &Posterior::friction_coefficient},
      {{"stress_pa", "stress before the rupture, in Pa", "", "Eqs. 8-10"}, &Posterior::stress_pa},
  };
  return quantities;
}

namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();

}  // namespace

std::vector<Description> population_quantities() {
  std::vector<Description> all;
  for (const auto& q : measured_quantities()) all.push_back(q.about);
  for (const auto& q : inferred_quantities()) all.push_back(q.about);
  for (const auto& q : bound_quantities()) all.push_back(q.about);
  return all;
}

std::optional<catalogue::Member> member_of(const EventResult& result) {
  if (!result.estimate || !result.estimate->rupture_velocity) return {};
  catalogue::Member m{result.estimate->rupture_velocity->value, {}};
  for (const auto& q : measured_quantities()) m.values.push_back(((*result.estimate).*q.value).value_or(none));
  for (const auto quantities : {inferred_quantities(), bound_quantities()})
    for (const auto& q : quantities) {
      const auto& x = (*result.estimate).*q.value;
      m.values.push_back(x ? x->value : none);
    }
  return m;
}

}  // namespace slipfront::results
