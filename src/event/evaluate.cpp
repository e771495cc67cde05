#include "slipfront/event/evaluate.hpp"

#include <utility>

#include "slipfront/medium/quantity.hpp"

namespace slipfront::event {

EventResult evaluate(Entry&& entry, const MediumDefaults& defaults) {
  EventResult result{std::move(entry.observation), {}, {}};
  try {
    if (entry.error) throw InputError(*entry.error);
    result.estimate = estimate(result.observation, defaults);
  } catch (const InputError& error) {
    result.error = error.what();
  }
  return result;
}

MediumDefaults defaults_of(const StatedMedium& stated) {
  MediumDefaults d;
  const auto set = [](const std::string& text, const char* option, medium::Dimension dimension, double& value,
                      bool& is_stated) {
    if (text.empty()) return;
    try {
      const auto span = medium::parse_quantity(text, dimension);
      if (span.low < span.high)
        throw InputError({.value = text,
                          .problem = "a range, where one number is needed",
                          .allowed = std::string(medium::example(dimension))});
      value = span.low;
      is_stated = true;
    } catch (const InputError& error) {
      Complaint c = error.complaint();
      c.file = "command line";
      c.key = option;
      throw InputError(c);
    }
  };
  using medium::Dimension;
  set(stated.p_wave_speed, "--p-wave-speed", Dimension::velocity, d.p_wave_speed, d.stated_speed);
  set(stated.poisson_ratio, "--poisson-ratio", Dimension::ratio, d.poisson_ratio, d.stated_poisson);
  set(stated.shear_modulus, "--shear-modulus", Dimension::pressure, d.shear_modulus, d.stated_modulus);
  return d;
}

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
      {{"stress_pa", "stress before the rupture, in Pa", "", "Eqs. 8-10"}, &Estimate::stress_pa},
  };
  return quantities;
}

}  // namespace slipfront::event
