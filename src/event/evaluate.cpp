#include "slipfront/event/evaluate.hpp"

#include <utility>

#include "slipfront/event/saved.hpp"
#include "slipfront/medium/quantity.hpp"

namespace slipfront::event {

std::vector<std::string> EventResult::warnings() const {
  std::vector<std::string> all = estimate ? estimate->warnings : observation.warnings;
  if (posterior) all.insert(all.end(), posterior->notes.begin(), posterior->notes.end());
  return all;
}

namespace {

/// The interval of samples; none where nothing moved.
std::optional<Interval> interval_of(const Quantiles& q) {
  if (!(q.low < q.high)) return {};
  return Interval{q.low, q.high};
}

/// The posterior's answer instead of that of the closed forms.
void fill(Estimate& e, const Posterior& p) {
  const auto set = [](std::optional<Inferred>& to, const std::optional<Quantiles>& from) {
    if (from) to = Inferred{from->median, interval_of(*from)};
  };
  set(e.rupture_velocity, p.rupture_velocity);
  set(e.stress, p.stress);
  set(e.frictionless_slip_velocity, p.frictionless_slip_velocity);
  set(e.observed_slip_velocity, p.observed_slip_velocity);
  set(e.slip_velocity_ratio, p.slip_velocity_ratio);
  set(e.contact_ratio, p.contact_ratio_bound);
  set(e.contact_ratio, p.contact_ratio);
  set(e.stress_pa, p.stress_pa);
  set(e.damping_number, p.damping_number);
  set(e.friction_coefficient, p.friction_coefficient);
  set(e.stress, p.stress_bound);
  set(e.stress_bound, p.stress_bound);
  set(e.contact_ratio_bound, p.contact_ratio_bound);
  set(e.stress_pa_bound, p.stress_pa_bound);
  if (p.suffices && p.friction_identified) e.contact_ratio_bound.reset(), e.stress_pa_bound.reset();
  if (p.suffices) return;
  for (const auto& q : inferred_quantities())
    if (e.*q.value) (e.*q.value)->interval.reset();
  for (const auto& q : bound_quantities())
    if (e.*q.value) (e.*q.value)->interval.reset();
}

bool is_sampled(const Plan& plan, const Observation& o) {
  return plan.sampling.samples > 0 && (plan.all || speaks_of_friction_or_error(o));
}

FaultPulse pulse_of(const EventResult& result, const MediumDefaults& defaults) {
  FaultPulse none;
  if (result.observation.subfaults.empty())
    none.reason = "no finite-fault model that gives the places of its subfaults";
  else if (!result.estimate->stress)
    none.reason = "no rupture velocity, so no stress of the event";
  if (!none.reason.empty()) return none;
  const std::vector<LocalState>& known = result.along_fault;
  return pulse_along_fault(known.empty() ? along_fault(result.observation, defaults) : known,
                           result.estimate->stress->value, result.estimate->speed);
}

/// What takes long comes from `posterior_of` and `pulse_of`.
template <class PosteriorOf, class PulseOf>
EventResult evaluate(Entry&& entry, const MediumDefaults& defaults, const Plan& plan, const PosteriorOf& posterior_of,
                     const PulseOf& pulse_of) {
  EventResult result{std::move(entry.observation), {}, {}, {}, {}, {}};
  try {
    if (entry.error) throw InputError(*entry.error);
    result.estimate = estimate(result.observation, defaults, is_sampled(plan, result.observation));
    result.posterior = posterior_of(result);
    if (result.posterior) fill(*result.estimate, *result.posterior);
    if (plan.along_fault) result.along_fault = along_fault(result.observation, defaults);
    result.pulse = pulse_of(result);
  } catch (const InputError& error) {
    result.estimate.reset();
    result.error = error.what();
  }
  return result;
}

}  // namespace

EventResult evaluate(Entry&& entry, const MediumDefaults& defaults, const Plan& plan) {
  return evaluate(
      std::move(entry), defaults, plan,
      [&](const EventResult& r) -> std::optional<Posterior> {
        if (!is_sampled(plan, r.observation)) return {};
        return posterior(r.observation, defaults, plan.sampling);
      },
      [&](const EventResult& r) { return plan.pulse ? std::optional(pulse_of(r, defaults)) : std::nullopt; });
}

EventResult evaluate(Entry&& entry, const MediumDefaults& defaults, const Plan& plan, Found&& found) {
  if (!found.error.empty()) return {std::move(entry.observation), {}, {}, {}, {}, std::move(found.error)};
  return evaluate(
      std::move(entry), defaults, plan, [&](const EventResult&) { return std::move(found.posterior); },
      [&](const EventResult&) { return std::move(found.pulse); });
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
      const bool is_ratio = dimension == medium::Dimension::ratio;  // said here, once for all events
      if (is_ratio ? !(span.low > -1 && span.low < 0.5) : !(span.low > 0))
        throw InputError(
            {.value = text, .problem = "out of range", .allowed = is_ratio ? "-1 < poisson_ratio < 0.5" : "> 0"});
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

}  // namespace slipfront::event
