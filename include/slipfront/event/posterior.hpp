#pragma once
/// \file
/// State of the fault with friction and uncertainty: what the observed quantities, each with its error, leave of
/// Sigma-, A, Gamma and C (docs/events.md).

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "slipfront/event/estimate.hpp"

namespace slipfront::event {

/// Prior of what is not observed: ln A even from `least_contact_ratio` to plastic contact, ln(1 + Gamma) even from 0 to
/// that of `most_damping_number`, ln V even.
inline constexpr double least_contact_ratio = 1e-8, most_damping_number = 1e8;

struct Sampling {
  std::size_t samples = 1000;  ///< points of the Sobol sequence, >= 1
  std::uint64_t seed = 1;      ///< of its shift, which differs from event to event
  modulation::Closure closure = modulation::Closure::consistent;
};

/// Points of a distribution.
struct Quantiles {
  double low;  ///< 5 %
  double median;
  double high;  ///< 95 %
};

/// One state that explains the observed velocities as well as any other.
struct TradeOff {
  double damping_number;
  double contact_ratio;
  double stress_pa;
};

/// Absent quantities are not identifiable; `notes` say why and what would settle it.
struct Posterior {
  std::optional<Quantiles> rupture_velocity, stress, contact_ratio, damping_number, friction_coefficient, stress_pa;
  bool friction_identified = false;  ///< else damping_number and contact_ratio only trade off
  /// Width of the 90 % interval (of ln A and ln(1 + Gamma)) over that of the prior: near 1, only the prior speaks.
  std::optional<double> contact_ratio_prior_share, damping_number_prior_share;
  std::vector<TradeOff> trade_off;  ///< where velocities alone are known: A and stress for given damping numbers
  std::vector<std::string> notes;
  double effective_samples = 0;  ///< (sum of weights)^2 / sum of squared weights
  std::size_t samples = 0;
  std::uint64_t seed = 0;  ///< of this event's shift
};

/// Whether an event says how uncertain it is, or carries anything that speaks of its friction.
bool speaks_of_friction_or_error(const Observation& observation);

/// By importance sampling at the points of a shifted Sobol sequence; the same bits however many threads call it.
/// Nothing without a rupture velocity. \throws InputError (with file and line) where no sample agrees with what was
/// observed, and for constants out of range.
std::optional<Posterior> posterior(const Observation& observation, const MediumDefaults& defaults,
                                   const Sampling& sampling);

}  // namespace slipfront::event
