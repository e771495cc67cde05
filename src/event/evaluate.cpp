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

/// The interval of samples, in `unit`; none where nothing moved.
std::optional<Interval> interval_of(const Quantiles& q, double unit = 1) {
  if (!(q.low < q.high)) return {};
  return Interval{q.low / unit, q.high / unit};
}

void fill(Estimate& e, const Posterior& p, const Observation& observation) {
  // V in m/s is sampled: it tells V / c where c is a plain number.
  if (e.rupture_velocity && !e.rupture_velocity->interval && p.rupture_velocity &&
      observation.uncertain_constants.empty())
    e.rupture_velocity->interval = interval_of(*p.rupture_velocity, e.speed);
  if (e.stress && !e.stress->interval && p.stress) e.stress->interval = interval_of(*p.stress);
  if (!p.friction_identified) return;
  const auto set = [](std::optional<Inferred>& to, const std::optional<Quantiles>& from) {
    if (from) to = Inferred{from->median, interval_of(*from)};
  };
  set(e.contact_ratio, p.contact_ratio);
  set(e.stress_pa, p.stress_pa);
  set(e.damping_number, p.damping_number);
  set(e.friction_coefficient, p.friction_coefficient);
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
    result.estimate = estimate(result.observation, defaults);
    result.posterior = posterior_of(result);
    if (result.posterior) fill(*result.estimate, *result.posterior, result.observation);
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
        if (plan.sampling.samples == 0 || !(plan.all || speaks_of_friction_or_error(r.observation))) return {};
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
