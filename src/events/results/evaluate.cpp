#include "events/results/evaluate.hpp"

#include <algorithm>
#include <string>
#include <utility>

#include "events/catalogue/keys.hpp"
#include "events/inference/sampling/proposal.hpp"
#include "events/inference/sampling/sampler.hpp"
#include "events/results/columns.hpp"
#include "math/digits.hpp"
#include "slipfront/error.hpp"
#include "slipfront/theory/medium/medium.hpp"
#include "slipfront/theory/rupture/relations.hpp"
#include "system/archive.hpp"
#include "system/machine.hpp"

namespace slipfront::results {

using inference::FaultState;
using inference::most_growth;
using inference::most_samples;
using inference::Sample;
using inference::Sampling;
using inference::ShiftedSobol;

namespace {

constexpr double result_itself = 4096;  // bytes of the texts, notes and quantiles of one result, without its draws
constexpr double texts_in_file = 400;

double draws_of(const EvaluationOptions& options) {
  return static_cast<double>(options.sampling.draws * (2 * sizeof(FaultState) + sizeof(inference::ObservedValues)));
}

/// The largest number of samples of one event.
double most_of(const Sampling& sampling) {
  return static_cast<double>(std::max(sampling.samples, std::min(most_growth * sampling.samples, most_samples)));
}

}  // namespace

double memory_needed(const EvaluationOptions& options, std::size_t events, int at_once) {
  // The number of samples doubles. So does the vector that holds them, and while it grows, its old half exists too. In
  // addition there are the weights and the order of samples. All Sobol sequences stay in memory, each twice as
  // long as the one before.
  const double of_sample = 3 * sizeof(Sample) + 4 * sizeof(double);
  const double most = most_of(options.sampling);
  const double kept = most > static_cast<double>(options.sampling.samples) ? 2 : 1;
  const double sequences = kept * sizeof(double) * static_cast<double>(ShiftedSobol::dimensions);
  const double together = std::min(static_cast<double>(events), static_cast<double>(at_once));
  return most * (together * of_sample + sequences) + static_cast<double>(events) * (result_itself + draws_of(options));
}

double disk_needed(const EvaluationOptions& options, std::size_t events) {
  double numbers = 0;
  for (const NumberColumn& c : number_columns({.pulse = options.pulse, .draws = options.sampling.draws}))
    numbers += static_cast<double>(c.count);
  // The draws are also in the state from which a run resumes, and in the groups.
  return static_cast<double>(events) * (sizeof(double) * numbers + 2 * draws_of(options) + texts_in_file);
}

void require_memory(const EvaluationOptions& options, std::size_t events, int at_once, bool with_file) {
  const auto needed = [&](const EvaluationOptions& o) {
    return memory_needed(o, events, at_once) + (with_file ? 2 * disk_needed(o, events) : 0);
  };
  const double need = needed(options), have = usable_memory();
  if (need <= have) return;
  EvaluationOptions without_draws = options;
  without_draws.sampling.draws = 0;
  const bool by_draws = needed(without_draws) < need / 2;
  throw InputError({.file = "command line",
                    .key = by_draws ? "--draws" : "--samples",
                    .value = std::to_string(by_draws ? options.sampling.draws : options.sampling.samples),
                    .problem = std::to_string(events) + " events, " + std::to_string(at_once) + " at a time, need " +
                               digits(need / 1e9, 3) + " GB of memory, this process may have " + digits(have / 1e9, 3) +
                               " GB",
                    .allowed = by_draws ? "fewer draws or events" : "fewer samples or threads"});
}

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

namespace {

void archive_quantiles(Archive& a, inference::QuantileQuantities& of) {
  for (const inference::Quantity& q : inference::quantities()) a(of.*q.quantiles);
}

void archive_posterior(Archive& a, inference::Posterior& p) {
  archive_quantiles(a, p);
  a(p.friction_identified, p.contact_ratio_prior_share, p.damping_number_prior_share, p.trade_off);
  a.each(p.tension, [&](inference::Tension& t) {
    a(t.observation, t.sigmas);
    archive_quantiles(a, t.without);
  });
  a.each(p.predictions, [&](inference::Prediction& one) { a(one.observation, one.below); });
  a(p.contradicted, p.draws, p.prior_draws, p.repeated, p.notes);
  a(p.suffices, p.effective_samples, p.pareto_k, p.samples, p.seed);
}

/// The members that take time to compute.
template <class Result>
void archive_result(Archive& a, Result& result) {
  a.maybe(result.posterior, [&](inference::Posterior& p) { archive_posterior(a, p); });
  a(result.pulse, result.error);
}

}  // namespace

std::string serialize(std::span<const EventResult> results) {
  std::string bytes;
  Archive a = Archive::to(bytes);
  for (const EventResult& r : results) archive_result(a, const_cast<EventResult&>(r));  // writing changes no member
  return bytes;
}

std::vector<SavedResult> deserialize(std::string_view saved) {
  std::vector<SavedResult> all;
  for (Archive a = Archive::from(saved); !a.at_end();) archive_result(a, all.emplace_back());
  return all;
}

}  // namespace slipfront::results
