#pragma once
/// \file
/// Infers the state of a fault with friction and uncertainty. The result is the posterior distribution of Sigma-, A,
/// Gamma and C, given the observed quantities with their errors (docs/events.md).

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "slipfront/events/inference/estimate.hpp"

namespace slipfront::inference {

/// Priors of the quantities that are not observed. ln A is uniform from `least_contact_ratio` to plastic contact.
/// ln(1 + Gamma) is uniform from 0 to its value at `most_damping_number`. ln V is uniform.
inline constexpr double least_contact_ratio = 1e-8, most_damping_number = 1e8;

struct Sampling {
  std::size_t samples = 1000;  ///< initial number of points of the Sobol sequence, >= 1
  std::uint64_t seed = 1;      ///< seed of the shift of the sequence; the observed numbers change it too
  friction::Closure closure = friction::Closure::consistent;
  std::size_t draws = 0;  ///< number of states of equal weight to return
};

/// Effective number of samples that an interval needs. The number of samples doubles until this is reached.
inline constexpr double least_effective_samples = 200;
/// The number of samples grows at most by the factor `most_growth`, and never above `most_samples`. An event is
/// rejected if none of eight times the initial number of samples is possible.
inline constexpr std::size_t most_growth = 64, most_samples = 262144;

/// One of the states that explain the observed velocities equally well.
struct TradeOff {
  double damping_number;
  double contact_ratio;
  double stress_pa;
};

/// An observation that disagrees with the others, and the result without it.
struct Tension {
  std::string observation;  ///< its key in a file
  /// Distance of the observation from what the others predict, in standard deviations: the normal quantile of the share
  /// of repeated observations below it (above 0: it is larger than predicted). Absent for an exact number that no
  /// sample comes near.
  std::optional<double> sigmas;
  QuantileQuantities without;  ///< the posterior without this observation
};

/// A posterior predictive check: the probability that a repeated observation of the inferred fault is below the actual
/// one. Near 0 or 1, the observation is not what the model with this posterior would give.
struct Prediction {
  std::string observation;
  double below;
};

/// A quantity is absent if the observations do not determine it, or if there are too few samples. `notes` give the
/// reason and name the observation that would help.
struct Posterior : QuantileQuantities {
  bool friction_identified = false;  ///< if false, only a combination of damping_number and contact_ratio is known
  /// Width of the 90 % interval of ln A and of ln(1 + Gamma), divided by that of the prior. Near 1, the data add
  /// nothing to the prior.
  std::optional<double> contact_ratio_prior_share, damping_number_prior_share;
  std::vector<TradeOff> trade_off;      ///< A and stress for given damping numbers, if only velocities are known
  std::vector<Tension> tension;         ///< observations at 2 or more standard deviations from the others
  std::vector<Prediction> predictions;  ///< one for each observation, if `suffices`
  bool contradicted = false;            ///< the observations exclude each other: there is no common posterior
  std::vector<FaultState> draws;        ///< as many as Sampling::draws, if `suffices`
  std::vector<FaultState> prior_draws;  ///< as many states drawn from the prior, if `suffices`
  /// A repeated observation of each of `draws`, with the error of the observation. A number is NaN if it was not
  /// observed, or if the observations only give bounds.
  std::vector<ObservedValues> repeated;
  std::vector<std::string> notes;
  bool suffices = false;         ///< there are enough samples for intervals; otherwise no quantity has one
  double effective_samples = 0;  ///< (sum of weights)^2 / sum of squared weights
  /// Shape k of the generalised Pareto distribution that fits the largest weights (Vehtari et al. 2024). Above
  /// min(0.7, 1 - 1 / log10(samples)) their tail is too heavy. It is 0 if the largest weights differ by less than a
  /// factor of two, and infinite if there are too few samples to fit.
  double pareto_k = 0;
  std::size_t samples = 0;  ///< final number of samples
  std::uint64_t seed = 0;   ///< seed of the shift for this event
};

/// Whether an event is sampled by default: it has an error, or observations that depend on friction, such as the
/// velocity of an observed front and a slip velocity.
bool needs_samples(const catalogue::Observation& observation);

/// Computes the posterior by importance sampling at the points of a shifted Sobol sequence. The result does not depend
/// on the number of threads that call it, to the last bit. It is absent without a rupture velocity, unless slip
/// velocity and contact ratio are known. \throws InputError (with file and line) if no sample agrees with the
/// observations, and for constants out of range.
std::optional<Posterior> posterior(const catalogue::Observation& observation, const medium::Defaults& defaults,
                                   const Sampling& sampling);

/// Replaces the results of the closed forms by those of the posterior, where it has them. Observations that exclude
/// each other leave no contact ratio and no stress in Pa.
void apply_posterior(Estimate& estimate, const Posterior& posterior);

}  // namespace slipfront::inference
