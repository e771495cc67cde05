#include "inference/tension.hpp"

#include <algorithm>
#include <cmath>

#include "inference/sampling/weighted_samples.hpp"

namespace slipfront::inference {

using catalogue::Measured;
using catalogue::Observation;

namespace {

constexpr std::size_t first_samples = 128, most_samples_of_prediction = 1024;
constexpr double least_effective_of_prediction = 64;
constexpr double least_sigmas = 2;

std::optional<Tension> tension_of(const std::string& name, const Measured& measured, const Observation& o,
                                  const medium::Defaults& defaults, const Sampling& sampling) {
  Sampling few = sampling;
  few.samples = first_samples;
  Sampler sampler(o, defaults, few, name);
  if (sampler.mode() != Mode::friction || !(sampler.least_misfit() < hopeless_misfit)) return {};
  const WeightedSamples samples =
      draw_samples(sampler, first_samples, most_samples_of_prediction, least_effective_of_prediction);
  if (samples.accepted.empty()) return {};
  std::optional<std::size_t> position;
  for (std::size_t i = 0; i < sampler.evidence().size(); ++i)
    if (sampler.evidence()[i].name == name) position = i;
  Tension t{name, samples.sigmas_above(measured, position), {}};
  if (t.sigmas && std::fabs(*t.sigmas) < least_sigmas) return {};
  for (const Quantity& q : posterior_quantities()) t.without.*q.quantiles = samples.quantiles(q.state);
  return t;
}

}  // namespace

std::vector<Tension> tensions(const Observation& o, const medium::Defaults& defaults, const Sampling& sampling) {
  std::vector<Tension> all;
  const std::vector<Evidence> evidence = evidence_of(o);
  if (evidence.size() + (o.rupture_velocity_m_s ? 1 : 0) < 2) return all;
  const auto add = [&](const std::string& name, const Measured& measured) {
    if (auto t = tension_of(name, measured, o, defaults, sampling)) all.push_back(std::move(*t));
  };
  if (o.rupture_velocity_m_s) add("rupture_velocity", *o.rupture_velocity_m_s);
  for (const Evidence& e : evidence) add(e.name, e.measured);
  std::stable_sort(all.begin(), all.end(), [](const Tension& a, const Tension& b) {
    return std::fabs(a.sigmas.value_or(1e9)) > std::fabs(b.sigmas.value_or(1e9));
  });
  return all;
}

}  // namespace slipfront::inference
