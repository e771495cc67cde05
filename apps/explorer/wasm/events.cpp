/// \file
/// Panel "Stress and velocity": an event that somebody types, put through the theory.

#include "answer.hpp"
#include "slipfront/events/catalogue/read.hpp"
#include "slipfront/events/inference/estimate.hpp"
#include "slipfront/events/inference/posterior.hpp"

namespace slipfront::explorer {
namespace {

using inference::Quantity;

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
    const bool sampled = samples > 0 && inference::needs_samples(observation);
    inference::Estimate estimate = inference::estimate(observation, {}, sampled);
    const auto posterior = sampled
                               ? inference::posterior(observation, {}, {.samples = static_cast<std::size_t>(samples)})
                               : std::optional<inference::Posterior>();
    if (posterior) inference::apply_posterior(estimate, *posterior);
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
