/// \file
/// Panel "Stress and velocity": an event that somebody types, put through the theory.

#include "answer.hpp"
#include "slipfront/catalogue/read.hpp"
#include "slipfront/inference/estimate.hpp"
#include "slipfront/inference/posterior.hpp"

namespace slipfront::explorer {
namespace {

using inference::Quantity;

/// Median and interval from samples; the interval is none where nothing moved.
inference::Inferred from(const inference::Quantiles& q, bool suffices) {
  const bool known = suffices && q.low < q.high;
  return {q.median, known ? std::optional(inference::Interval{q.low, q.high}) : std::nullopt};
}

/// The samples' answer instead of that of the closed forms, as results/evaluate.cpp has it: where only a bound is
/// known, it is the answer.
void fill(inference::Estimate& estimate, const inference::Posterior& p) {
  for (const Quantity& q : inference::quantities())
    if (p.*q.quantiles) estimate.*q.inferred = from(*(p.*q.quantiles), p.suffices);
  if (!p.contact_ratio && p.contact_ratio_bound) estimate.contact_ratio = from(*p.contact_ratio_bound, p.suffices);
  if (p.stress_bound) estimate.stress = from(*p.stress_bound, p.suffices);
  if (p.suffices && p.friction_identified) estimate.contact_ratio_bound.reset(), estimate.stress_pa_bound.reset();
  if (p.suffices) return;
  for (const Quantity& q : inference::quantities())
    if (estimate.*q.inferred) (estimate.*q.inferred)->interval.reset();
}

void put_quantity(Object& object, const inference::Estimate& estimate, const Quantity& quantity) {
  const std::string name(quantity.about.name);
  const auto& value = estimate.*quantity.inferred;
  const bool known = value && value->interval;
  object.put(name, value ? std::optional(value->value) : std::nullopt);
  object.put(name + "_low", known ? std::optional(value->interval->low) : std::nullopt);
  object.put(name + "_high", known ? std::optional(value->interval->high) : std::nullopt);
}

}  // namespace

/// An event as TOML, tables [event] and [medium], with errors and units as docs/events.md has them. `samples` > 0:
/// sampled where it speaks of its friction or of its errors.
SLIPFRONT_EXPORT const char* event(const char* toml, int samples) {
  return answer([=] {
    const catalogue::Observation observation = catalogue::read_toml(toml, "");
    const bool sampled = samples > 0 && inference::speaks_of_friction_or_error(observation);
    inference::Estimate estimate = inference::estimate(observation, {}, sampled);
    const auto posterior = sampled
                               ? inference::posterior(observation, {}, {.samples = static_cast<std::size_t>(samples)})
                               : std::optional<inference::Posterior>();
    if (posterior) fill(estimate, *posterior);
    Object object;
    object.put("name", observation.name).put("c_m_s", estimate.speed);
    object.put("rupture_velocity_m_s", estimate.observed_rupture_velocity_m_s);
    object.put("slip_velocity_m_s", estimate.observed_slip_velocity_m_s);
    for (const Quantity& q : inference::quantities()) put_quantity(object, estimate, q);
    std::vector<std::string> warnings = estimate.warnings;
    if (posterior) warnings.insert(warnings.end(), posterior->notes.begin(), posterior->notes.end());
    return object.put("sampled", posterior.has_value())
        .put("friction_identified", posterior && posterior->friction_identified)
        .put("warnings", warnings);
  });
}

}  // namespace slipfront::explorer
