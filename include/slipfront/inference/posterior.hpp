#pragma once
/// \file
/// State of the fault with friction and uncertainty: what the observed quantities, each with its error, leave of
/// Sigma-, A, Gamma and C (docs/events.md).

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "slipfront/inference/estimate.hpp"

namespace slipfront::inference {

/// Prior of what is not observed: ln A even from `least_contact_ratio` to plastic contact, ln(1 + Gamma) even from 0 to
/// that of `most_damping_number`, ln V even.
inline constexpr double least_contact_ratio = 1e-8, most_damping_number = 1e8;

struct Sampling {
  std::size_t samples = 1000;  ///< points of the Sobol sequence to begin with, >= 1
  std::uint64_t seed = 1;      ///< of its shift, which differs from event to event
  friction::Closure closure = friction::Closure::consistent;
  std::size_t draws = 0;  ///< states to keep, alike in weight
};

/// What samples must reach before an interval is given; they double until they do.
inline constexpr double least_effective_samples = 200;
/// They double up to this many times their number, or this many in all; an event that none of eight times their number
/// can be is refused.
inline constexpr std::size_t most_growth = 64, most_samples = 262144;

/// One state that explains the observed velocities as well as any other.
struct TradeOff {
  double damping_number;
  double contact_ratio;
  double stress_pa;
};

/// Absent quantities are not identifiable, or the samples do not suffice; `notes` say why and what would settle it.
struct Posterior : FaultQuantities<std::optional<Quantiles>> {
  bool friction_identified = false;  ///< else damping_number and contact_ratio only trade off
  /// Width of the 90 % interval (of ln A and ln(1 + Gamma)) over that of the prior: near 1, only the prior speaks.
  std::optional<double> contact_ratio_prior_share, damping_number_prior_share;
  std::vector<TradeOff> trade_off;  ///< where velocities alone are known: A and stress for given damping numbers
  std::vector<FaultState> draws;    ///< as many as were asked for, if the samples suffice
  std::vector<std::string> notes;
  bool suffices = false;         ///< the samples are enough for intervals: else there are none
  double effective_samples = 0;  ///< (sum of weights)^2 / sum of squared weights
  /// Shape k of the generalised Pareto distribution that fits the largest weights (Vehtari et al. 2024): above
  /// min(0.7, 1 - 1 / log10(samples)) they have too heavy a tail. 0 where the largest weights are alike within a factor
  /// of two; infinite for too few samples to tell.
  double pareto_k = 0;
  std::size_t samples = 0;  ///< at the end
  std::uint64_t seed = 0;   ///< of this event's shift
};

/// Whether an event says how uncertain it is, or carries anything that speaks of its friction.
bool speaks_of_friction_or_error(const catalogue::Observation& observation);

/// By importance sampling at the points of a shifted Sobol sequence; the same bits however many threads call it.
/// Nothing without a rupture velocity, unless slip velocity and contact ratio are known. \throws InputError (with file
/// and line) where no sample agrees with what was observed, and for constants out of range.
std::optional<Posterior> posterior(const catalogue::Observation& observation, const medium::Defaults& defaults,
                                   const Sampling& sampling);

}  // namespace slipfront::inference
