#include "results/evaluate.hpp"

#include <utility>

#include "catalogue/derived.hpp"
#include "results/quantities.hpp"
#include "results/serialize.hpp"
#include "slipfront/medium/medium.hpp"
#include "slipfront/rupture/relations.hpp"

namespace slipfront::results {

using catalogue::Entry;
using catalogue::Observation;
using finite_fault::along_fault;
using finite_fault::FaultPulse;
using finite_fault::LocalState;
using finite_fault::pulse_along_fault;
using inference::apply_posterior;
using inference::estimate;
using inference::needs_samples;
using inference::Posterior;
using inference::posterior;

std::vector<std::string> EventResult::warnings() const {
  std::vector<std::string> all = estimate ? estimate->warnings : observation.warnings;
  if (posterior) all.insert(all.end(), posterior->notes.begin(), posterior->notes.end());
  return all;
}

namespace {

bool is_sampled(const EvaluationOptions& options, const Observation& o) {
  return options.sampling.samples > 0 && (options.sample_all || needs_samples(o));
}

Frictionless frictionless_of(const inference::InferredQuantities& closed_forms) {
  const auto value = [](const auto& bound, const auto& known) -> std::optional<double> {
    if (bound) return bound->value;
    return known ? std::optional(known->value) : std::nullopt;
  };
  return {value(closed_forms.stress_pa_bound, closed_forms.stress_pa),
          value(closed_forms.contact_ratio_bound, closed_forms.contact_ratio)};
}

/// States that there are no draws, or that they are of lower bounds. Empty if there are draws of the quantities.
std::string warning_of_draws(const EventResult& result) {
  if (!result.posterior) return "no draws: the event is not sampled (option samples), because no number has an error";
  std::string bounds;
  for (const inference::Quantity& quantity : inference::bound_quantities())
    if ((*result.estimate).*quantity.inferred)
      bounds += (bounds.empty() ? "draw_" : ", draw_") + std::string(quantity.about.name);
  if (bounds.empty() || !result.posterior->suffices) return {};
  return "only lower bounds are known, and the draws are of these: " + bounds;
}

FaultPulse pulse_of(const EventResult& result, const medium::Defaults& defaults) {
  FaultPulse none;
  if (result.observation.subfaults.empty())
    none.reason = "no finite-fault model with positions of its subfaults";
  else if (!result.estimate->rupture_velocity)
    none.reason = "no rupture velocity, so the stress of the event is unknown";
  if (!none.reason.empty()) return none;
  const std::vector<LocalState>& known = result.along_fault;
  return pulse_along_fault(known.empty() ? along_fault(result.observation, defaults) : known,
                           rupture::from_rupture_velocity(result.estimate->rupture_velocity->value).stress,
                           result.estimate->speed);  // the pulse has no friction: its front runs at |V-|
}

/// Evaluates an entry. `posterior_of` and `pulse_of` supply the results that take long to compute.
template <class PosteriorOf, class PulseOf>
EventResult evaluate(Entry&& entry, const medium::Defaults& defaults, const EvaluationOptions& options,
                     const PosteriorOf& posterior_of, const PulseOf& pulse_of) {
  EventResult result{std::move(entry.observation), {}, {}, {}, {}, {}};
  try {
    if (entry.error) throw InputError(*entry.error);
    const medium::Elastic elastic = medium::elastic(result.observation, defaults);
    catalogue::derive(result.observation, elastic.shear_modulus, elastic.speed);
    result.estimate = estimate(result.observation, defaults, is_sampled(options, result.observation));
    result.frictionless = frictionless_of(*result.estimate);
    result.posterior = posterior_of(result);
    if (result.posterior) apply_posterior(*result.estimate, *result.posterior);
    if (options.sampling.draws > 0)
      if (const std::string warning = warning_of_draws(result); !warning.empty())
        result.estimate->warnings.push_back(warning);
    std::vector<LocalState> states = along_fault(result.observation, defaults);
    result.faster_than_c = finite_fault::faster_than(states, result.estimate->speed);
    if (options.along_fault) result.along_fault = std::move(states);
    if (const std::string warning = warning_of(result.faster_than_c, result.estimate->speed); !warning.empty())
      result.estimate->warnings.push_back(warning);
    result.pulse = pulse_of(result);
  } catch (const InputError& error) {
    result.estimate.reset();
    result.error = error.what();
  }
  return result;
}

}  // namespace

EventResult evaluate(Entry&& entry, const medium::Defaults& defaults, const EvaluationOptions& options) {
  return evaluate(
      std::move(entry), defaults, options,
      [&](const EventResult& r) -> std::optional<Posterior> {
        if (!is_sampled(options, r.observation)) return {};
        return posterior(r.observation, defaults, options.sampling);
      },
      [&](const EventResult& r) { return options.pulse ? std::optional(pulse_of(r, defaults)) : std::nullopt; });
}

EventResult evaluate(Entry&& entry, const medium::Defaults& defaults, const EvaluationOptions& options,
                     SavedResult&& found) {
  if (!found.error.empty()) return {std::move(entry.observation), {}, {}, {}, {}, std::move(found.error)};
  return evaluate(
      std::move(entry), defaults, options, [&](const EventResult&) { return std::move(found.posterior); },
      [&](const EventResult&) { return std::move(found.pulse); });
}

}  // namespace slipfront::results
