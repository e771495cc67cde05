#pragma once
/// \file
/// Entries of a file put through the theory, and the names of what comes out.

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "slipfront/description.hpp"
#include "slipfront/event/along_fault.hpp"
#include "slipfront/event/estimate.hpp"
#include "slipfront/event/posterior.hpp"
#include "slipfront/event/pulse_along_fault.hpp"

namespace slipfront::event {

/// One event of a file, after the theory: an estimate or the reason why there is none.
struct EventResult {
  Observation observation;
  /// One answer: by the closed forms at the middle of what was observed; where the event was sampled and the samples
  /// suffice, the median and the interval of the posterior.
  std::optional<Estimate> estimate;
  std::optional<Posterior> posterior;   ///< where the event was sampled
  std::vector<LocalState> along_fault;  ///< of a finite-fault model, if asked for
  std::optional<FaultPulse> pulse;      ///< through its slip distribution, if asked for
  std::string error;                    ///< one line; empty when there is an estimate

  /// Those of the closed forms, then what the samples say.
  std::vector<std::string> warnings() const;
};

/// What is done with an event besides the closed forms.
struct Plan {
  Sampling sampling;         ///< no samples: none
  bool all = false;          ///< sample all events, or those that speak of friction or of their errors
  bool along_fault = false;  ///< the closed forms subfault by subfault
  bool pulse = false;        ///< a pulse through the slip distribution of a finite-fault model
};

/// Bytes that it takes to evaluate `events` events, `at_once` of them at a time, and to keep their results.
double memory_needed(const Plan& plan, std::size_t events, int at_once);
/// Bytes of a file of them, which is made in memory.
double disk_needed(const Plan& plan, std::size_t events);
/// \throws InputError, which says both, if that is more memory than this process may have.
void require_memory(const Plan& plan, std::size_t events, int at_once, bool with_file = false);

/// Never throws InputError: what is wrong with the entry is in the result.
EventResult evaluate(Entry&& entry, const MediumDefaults& defaults, const Plan& plan);

/// The constants of the medium as a user states them, such as "6 km/s", 0.3 and "30 GPa"; empty: the default.
struct StatedMedium {
  std::string p_wave_speed, poisson_ratio, shear_modulus;
};
/// \throws InputError that names the option.
MediumDefaults defaults_of(const StatedMedium& stated);

/// Members of Estimate by name, in the order of output.
template <class T>
struct EstimateQuantity {
  Description about;
  std::optional<T> Estimate::*value;
};
std::span<const EstimateQuantity<double>> measured_quantities();
std::span<const EstimateQuantity<Inferred>> inferred_quantities();
std::span<const EstimateQuantity<Inferred>> bound_quantities();  ///< lower bounds, if friction took nothing

/// Members of Posterior by name, likewise.
struct PosteriorQuantity {
  Description about;
  std::optional<Quantiles> Posterior::*value;
};
std::span<const PosteriorQuantity> posterior_quantities();

}  // namespace slipfront::event
