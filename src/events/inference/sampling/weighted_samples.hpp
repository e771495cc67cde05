#pragma once
/// \file
/// The accepted samples of an event, and whether they suffice.

#include <cstddef>
#include <vector>

#include "events/inference/sampling/sampler.hpp"
#include "slipfront/events/inference/quantities.hpp"

namespace slipfront::inference {

struct Weighted {
  double value, weight;  ///< weight > 0
};

/// 5, 50 and 95 % of weighted values, at least one, ascending: linear between the middles of their steps.
inline Quantiles weighted_quantiles(const std::vector<Weighted>& values) {
  double total = 0;
  for (const Weighted& v : values) total += v.weight;
  const auto at = [&](double share) {
    double below = 0, last_middle = 0;
    for (std::size_t i = 0; i < values.size(); ++i) {
      const double middle = below + values[i].weight / 2;
      if (middle >= share * total) {
        if (i == 0) return values[0].value;
        const double s = (share * total - last_middle) / (middle - last_middle);
        return values[i - 1].value + s * (values[i].value - values[i - 1].value);
      }
      below += values[i].weight;
      last_middle = middle;
    }
    return values.back().value;
  };
  return {at(0.05), at(0.5), at(0.95)};
}

struct WeightedSamples {
  std::vector<Sample> accepted;
  double effective = 0, pareto_k = 0;
  std::size_t drawn = 0;

  /// Whether the weights are so even that their tail does not matter.
  bool are_even() const { return effective >= 0.2 * static_cast<double>(drawn); }
  bool tail_is_light() const;
  bool suffice(double least_effective = least_effective_samples) const {
    return effective >= least_effective && (are_even() || tail_is_light());
  }
  /// Whether the samples suffice for one quantity: the tail of its weighted distances from the median is light too.
  bool suffice_for(double FaultState::*quantity, double median) const;
  /// The quantiles of a quantity; absent if it is unknown.
  std::optional<Quantiles> quantiles(double FaultState::*quantity) const;
  /// Samples that have equal weight, by systematic resampling. One sample can occur more than once.
  std::vector<const Sample*> draws(std::size_t count) const;
  /// Probability that a repeated observation is below the actual one. `i` is its position in `evidence`; the rupture
  /// velocity has none.
  double below(const catalogue::MeasuredValue& measured, std::optional<std::size_t> i) const;
  /// Distance of an observation above the nearest prediction, in its standard deviations. Absent for an exact number.
  std::optional<double> nearest_deviation(const catalogue::MeasuredValue& measured, std::optional<std::size_t> i) const;
};

/// Probabilities that a repeated observation of the true value x is below and above the middle of the actual one.
struct Shares {
  double below, above;
};
Shares shares_of(const catalogue::MeasuredValue& measured, double x);

/// Doubles the number of samples until they suffice or reach `most`. It also stops when even `most` would not give
/// enough effective samples.
WeightedSamples draw_samples(Sampler& sampler, std::size_t first, std::size_t most,
                             double least_effective = least_effective_samples);

/// Shape k of the generalised Pareto distribution of the min(n / 5, 3 sqrt n) largest of n importance weights. It is
/// the diagnostic of Pareto-smoothed importance sampling (Vehtari, Simpson, Gelman, Yao & Gabry 2024, J. Mach. Learn.
/// Res. 25(72)), fitted with the method of Zhang & Stephens (2009, Technometrics 51, 316). It is 0 if these weights
/// differ by less than a factor of two, and infinite for fewer than 25 weights.
double pareto_k(std::vector<double> weights);

/// The largest k at which a mean over `samples` weights is reliable (Eq. 13 of Vehtari et al.).
double most_pareto_k(double samples);

}  // namespace slipfront::inference
