#include "events/inference/tension.hpp"

#include <algorithm>
#include <boost/math/special_functions/erf.hpp>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

#include "events/inference/sampling/weighted_samples.hpp"

namespace slipfront::inference {

using catalogue::MeasuredValue;
using catalogue::Observation;

namespace {

constexpr std::size_t first_samples = 128, most_samples_of_prediction = 1024;
constexpr double least_effective_of_prediction = 64;
constexpr double least_sigmas = 2;

/// The seed of the samples is fixed, so that a tension does not depend on that of the posterior.
constexpr std::uint64_t seed_of_tensions = 1;
/// Samples of each range of predicted values. Their number doubles until this changes the result by less than `settled`
/// standard deviations two times.
constexpr std::size_t first_samples_of_range = 256, most_samples_of_range = 8192;
constexpr double settled = 0.02;
constexpr double least_ratio = 1e-14, most_ratio = 1e14;  // ratios of predicted to observed values

/// Ranges of the predicted value, next to each other, which together cover all. They are narrow around the observed
/// value, because the probability of a tension comes from there, however small it is. Wider ones follow, because a
/// sampler finds a narrow prediction in a wide range with few of its samples only.
std::vector<MeasuredValue> ranges_of(const MeasuredValue& m) {
  std::vector<double> edges;
  if (m.shape == MeasuredValue::Shape::range) {
    edges = m.is_exact() ? std::vector<double>{m.low} : std::vector<double>{m.low, m.high};
  } else {
    for (const double z : {-5.0, -3.0, -1.0, 1.0, 3.0, 5.0}) {
      const double spread = m.shape == MeasuredValue::Shape::split && z < 0 ? m.spread_below : m.spread;
      edges.push_back(m.shape == MeasuredValue::Shape::lognormal ? m.low * std::pow(spread, z) : m.low + z * spread);
    }
  }
  std::erase_if(edges, [](double edge) { return !(edge > 0); });
  const double low = edges.front(), high = edges.back();
  for (const double e_folds : {0.5, 1.0, 1.5, 2.0, 3.0, 4.0, 6.0, 9.0})
    for (const double edge : {m.middle() * std::exp(-e_folds), m.middle() * std::exp(e_folds)})
      if (edge < low || edge > high) edges.push_back(edge);
  std::sort(edges.begin(), edges.end());
  std::vector<MeasuredValue> ranges;
  double from = least_ratio * m.low;
  for (const double edge : edges)
    if (edge > from) {
      ranges.push_back(MeasuredValue{from, edge});
      from = edge;
    }
  ranges.push_back(MeasuredValue{from, most_ratio * m.low});
  return ranges;
}

/// The number of standard deviations of a normal distribution that has the probability `part` of `all` above it.
double sigmas_of(double part, double all) { return std::numbers::sqrt2 * boost::math::erfc_inv(2 * part / all); }

/// The position of an observation in the evidence of a sampler. The rupture velocity has none.
std::optional<std::size_t> position_in(const Sampler& sampler, const std::string& name) {
  for (std::size_t i = 0; i < sampler.evidence().size(); ++i)
    if (sampler.evidence()[i].name == name) return i;
  return {};
}

/// Adds samples [from, to) to the probabilities that a repeated observation is below and above the actual one.
void add_shares(Shares& sum, Sampler& sampler, const std::string& name, const MeasuredValue& measured, std::size_t from,
                std::size_t to) {
  const std::optional<std::size_t> position = position_in(sampler, name);
  sampler.grow(to);
  for (std::size_t i = from; i < to; ++i) {
    const Sample s = sampler.draw(i);
    if (!(s.weight > 0)) continue;
    const Shares share =
        shares_of(measured, position ? std::exp(s.predicted[*position]) : s.state.rupture_velocity_m_s);
    sum.below += s.weight * share.below;
    sum.above += s.weight * share.above;
  }
}

/// How far the observation is above the prediction of the others: the normal quantile of the probability that a
/// repeated observation is below the actual one. That probability is a sum over ranges of the predicted value. Each
/// range has samples of its own, so that a small probability has as small a relative error as a large one. Absent if no
/// state of the fault predicts a value on that side.
std::optional<double> sigmas_above(const std::string& name, const MeasuredValue& measured, const Observation& o,
                                   const medium::Defaults& defaults, const Sampling& sampling) {
  std::vector<std::pair<Sampler, Shares>> ranges;
  for (const MeasuredValue& range : ranges_of(measured)) {
    Sampler sampler(o, defaults, sampling, name, range);
    if (sampler.mode() != Mode::friction || !std::isfinite(sampler.least_misfit())) continue;
    ranges.emplace_back(std::move(sampler), Shares{0, 0});
  }
  std::optional<double> last;
  int steady = 0;
  for (std::size_t from = 0, to = first_samples_of_range;; from = to, to *= 2) {
    Shares sum{0, 0};
    for (auto& [sampler, shares] : ranges) {
      add_shares(shares, sampler, name, measured, from, to);
      sum.below += shares.below / static_cast<double>(to);
      sum.above += shares.above / static_cast<double>(to);
    }
    const double all = sum.below + sum.above, part = std::fmin(sum.below, sum.above);
    if (!(part / all > 0)) return {};
    const double now = sum.below < sum.above ? -sigmas_of(part, all) : sigmas_of(part, all);
    steady = last && std::fabs(now - *last) < settled ? steady + 1 : 0;
    if (steady == 2 || to >= most_samples_of_range) return now;
    last = now;
  }
}

std::optional<Tension> tension_of(const std::string& name, const MeasuredValue& measured, const Observation& o,
                                  const medium::Defaults& defaults, const Sampling& sampling) {
  Sampling few = sampling;
  few.samples = first_samples_of_range;
  few.seed = seed_of_tensions;
  Sampler sampler(o, defaults, few, name);
  if (sampler.mode() != Mode::friction || !(sampler.least_misfit() < hopeless_misfit)) return {};
  const WeightedSamples samples =
      draw_samples(sampler, first_samples, most_samples_of_prediction, least_effective_of_prediction);
  if (samples.accepted.empty()) return {};
  Tension t{name, sigmas_above(name, measured, o, defaults, few), {}};
  if (!t.sigmas) t.sigmas = samples.nearest_deviation(measured, position_in(sampler, name));
  if (t.sigmas && std::fabs(*t.sigmas) < least_sigmas) return {};
  for (const Quantity& q : posterior_quantities()) t.without.*q.quantiles = samples.quantiles(q.state);
  return t;
}

}  // namespace

std::vector<Tension> tensions(const Observation& o, const medium::Defaults& defaults, const Sampling& sampling) {
  std::vector<Tension> all;
  const std::vector<Evidence> evidence = evidence_of(o);
  if (evidence.size() + (o.rupture_velocity_m_s ? 1 : 0) < 2) return all;
  const auto add = [&](const std::string& name, const MeasuredValue& measured) {
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
