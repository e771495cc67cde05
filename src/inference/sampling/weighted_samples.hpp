#pragma once
/// \file
/// The accepted samples of an event, and whether they suffice.

#include <cstddef>
#include <vector>

#include "inference/sampling/sampler.hpp"

namespace slipfront::inference {

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
  double below(const catalogue::Measured& measured, std::optional<std::size_t> i) const;
  /// Distance of an observation above the nearest prediction, in its standard deviations. Absent for an exact number.
  std::optional<double> nearest_deviation(const catalogue::Measured& measured, std::optional<std::size_t> i) const;
};

/// Probabilities that a repeated observation of the true value x is below and above the middle of the actual one.
struct Shares {
  double below, above;
};
Shares shares_of(const catalogue::Measured& measured, double x);

/// Doubles the number of samples until they suffice or reach `most`. It also stops when even `most` would not give
/// enough effective samples.
WeightedSamples draw_samples(Sampler& sampler, std::size_t first, std::size_t most,
                             double least_effective = least_effective_samples);

}  // namespace slipfront::inference
