#include "events/inference/sampling/weighted_samples.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

namespace slipfront::inference {

using catalogue::MeasuredValue;

namespace {

double normal_share_below(double z) { return std::erfc(-z / std::numbers::sqrt2) / 2; }

/// Distance of an observation above the true value x, in its standard deviations: of a range, the distance from its
/// nearer end. NaN for an exact number.
double deviations_above(const MeasuredValue& m, double x) {
  switch (m.shape) {
    case MeasuredValue::Shape::normal:
      return (m.low - x) / m.spread;
    case MeasuredValue::Shape::split:
      return (m.low - x) / (x < m.low ? m.spread_below : m.spread);
    case MeasuredValue::Shape::lognormal:
      return std::log(m.low / x) / std::log(m.spread);
    case MeasuredValue::Shape::range:
      break;
  }
  if (m.is_exact()) return std::numeric_limits<double>::quiet_NaN();
  const double deviation = (m.high - m.low) / std::sqrt(12.0);
  return (std::clamp(x, m.low, m.high) - x) / deviation;
}

void weigh(WeightedSamples& s) {
  double sum = 0, squares = 0;
  std::vector<double> weights;
  weights.reserve(s.accepted.size());
  for (const Sample& sample : s.accepted) {
    sum += sample.weight;
    squares += sample.weight * sample.weight;
    weights.push_back(sample.weight);
  }
  s.effective = s.accepted.empty() ? 0 : sum / squares * sum;
  s.pareto_k = inference::pareto_k(std::move(weights));
}

}  // namespace

Shares shares_of(const MeasuredValue& m, double x) {
  if (m.shape != MeasuredValue::Shape::range) {
    const double z = deviations_above(m, x);
    return {normal_share_below(z), normal_share_below(-z)};
  }
  if (m.is_exact()) {
    const double below = std::fabs(x / m.low - 1) < 1e-9 ? 0.5 : x < m.low ? 1 : 0;
    return {below, 1 - below};
  }
  const double below = std::clamp((m.high - x) / (m.high - m.low), 0.0, 1.0);
  return {below, 1 - below};
}

bool WeightedSamples::tail_is_light() const { return pareto_k <= most_pareto_k(static_cast<double>(accepted.size())); }

bool WeightedSamples::suffice_for(double FaultState::*quantity, double median) const {
  if (are_even()) return true;
  std::vector<double> terms;
  for (const Sample& s : accepted) terms.push_back(s.weight * std::fabs(std::log(s.state.*quantity / median)));
  return inference::pareto_k(std::move(terms)) <= most_pareto_k(static_cast<double>(accepted.size()));
}

std::optional<Quantiles> WeightedSamples::quantiles(double FaultState::*quantity) const {
  if (accepted.empty() || std::isnan(accepted.front().state.*quantity)) return {};
  std::vector<Weighted> values;
  values.reserve(accepted.size());
  for (const Sample& s : accepted) values.push_back({s.state.*quantity, s.weight});
  std::sort(values.begin(), values.end(), [](const Weighted& a, const Weighted& b) { return a.value < b.value; });
  return weighted_quantiles(values);
}

std::vector<const Sample*> WeightedSamples::draws(std::size_t count) const {
  double total = 0, below = 0;
  for (const Sample& s : accepted) total += s.weight;
  std::vector<const Sample*> all;
  for (const Sample& s : accepted) {
    below += s.weight;
    while (all.size() < count && (static_cast<double>(all.size()) + 0.5) * total <= below * static_cast<double>(count))
      all.push_back(&s);
  }
  while (all.size() < count) all.push_back(&accepted.back());
  return all;
}

double WeightedSamples::below(const MeasuredValue& measured, std::optional<std::size_t> i) const {
  double sum = 0, share = 0;
  for (const Sample& s : accepted) {
    const double x = i ? std::exp(s.predicted[*i]) : s.state.rupture_velocity_m_s;
    sum += s.weight;
    share += s.weight * shares_of(measured, x).below;
  }
  return share / sum;
}

std::optional<double> WeightedSamples::nearest_deviation(const MeasuredValue& measured,
                                                         std::optional<std::size_t> i) const {
  std::optional<double> nearest;
  for (const Sample& s : accepted) {
    const double z = deviations_above(measured, i ? std::exp(s.predicted[*i]) : s.state.rupture_velocity_m_s);
    if (!std::isnan(z) && (!nearest || std::fabs(z) < std::fabs(*nearest))) nearest = z;
  }
  return nearest;
}

WeightedSamples draw_samples(Sampler& sampler, std::size_t first, std::size_t most, double least_effective) {
  WeightedSamples s;
  s.drawn = first;
  for (std::size_t begin = 0;; begin = s.drawn, s.drawn = std::min(2 * s.drawn, most)) {
    sampler.grow(s.drawn);
    for (std::size_t i = begin; i < s.drawn; ++i)
      if (const Sample sample = sampler.draw(i); sample.weight > 0) s.accepted.push_back(sample);
    weigh(s);
    if (!sampler.is_uncertain()) return s;
    // The number of effective samples grows with the number of samples. We allow a factor of 4 for events that the
    // first few samples misjudge.
    const double promised = 4 * s.effective * static_cast<double>(most) / static_cast<double>(s.drawn);
    if (s.suffice(least_effective) || s.drawn >= most || (s.drawn >= 8 * first && promised < least_effective)) return s;
  }
}

namespace {

/// Mean of ln(1 + a x).
double shape_at(const std::vector<double>& x, double a) {
  double sum = 0;
  for (const double value : x) sum += std::log1p(a * value);
  return sum / static_cast<double>(x.size());
}

/// Shape of the generalised Pareto distribution of `x` > 0, ascending: the mean over a profile likelihood, drawn
/// towards 0.5 by ten more values.
double fitted_shape(const std::vector<double>& x) {
  const auto n = static_cast<double>(x.size());
  const double quartile = x[(x.size() + 2) / 4 - 1], largest = x.back();
  const int points = 30 + static_cast<int>(std::sqrt(n));
  std::vector<double> a, likelihood;
  for (int j = 1; j <= points; ++j) {
    a.push_back((std::sqrt(points / (j - 0.5)) - 1) / (3 * quartile) - 1 / largest);
    const double k = shape_at(x, a.back());
    likelihood.push_back(n * (std::log(a.back() / k) - k - 1));
  }
  const double most = *std::max_element(likelihood.begin(), likelihood.end());
  double sum = 0, mean = 0;
  for (std::size_t j = 0; j < a.size(); ++j) {
    const double weight = std::exp(likelihood[j] - most);
    sum += weight;
    mean += weight * a[j];
  }
  return (n * shape_at(x, mean / sum) + 10 * 0.5) / (n + 10);
}

}  // namespace

double pareto_k(std::vector<double> weights) {
  if (weights.size() < 25) return std::numeric_limits<double>::infinity();
  const auto n = static_cast<double>(weights.size());
  const auto tail = static_cast<std::ptrdiff_t>(std::fmin(n / 5, 3 * std::sqrt(n)));
  std::nth_element(weights.begin(), weights.end() - tail - 1, weights.end());
  const double cutoff = *(weights.end() - tail - 1);
  // Weights of a heavy tail differ by far more: 95 of them by a factor of 24 at k = 0.7.
  if (*std::max_element(weights.end() - tail, weights.end()) < 2 * cutoff) return 0;
  std::vector<double> above;
  for (auto w = weights.end() - tail; w != weights.end(); ++w)
    if (*w > cutoff * (1 + 1e-9)) above.push_back(*w - cutoff);
  if (above.size() < 5) return 0;
  std::sort(above.begin(), above.end());
  return fitted_shape(above);
}

double most_pareto_k(double samples) { return std::fmin(0.7, 1 - 1 / std::log10(samples)); }

}  // namespace slipfront::inference
