#pragma once
/// \file
/// Applies the theory to the entries of a file.

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "finite_fault/along_fault.hpp"
#include "finite_fault/pulse_along_fault.hpp"
#include "slipfront/description.hpp"
#include "slipfront/inference/estimate.hpp"
#include "slipfront/inference/posterior.hpp"

namespace slipfront::results {

/// The closed forms at the middles of the observed quantities, where friction is not known.
struct Frictionless {
  std::optional<double> stress_pa, contact_ratio;
};

/// The result for one event of a file: an estimate, or the reason why there is none.
struct EventResult {
  catalogue::Observation observation;
  /// The result. If the event was sampled and the samples suffice, it is the median and the interval of the posterior.
  /// Otherwise it follows from the closed forms at the middles of the observed quantities.
  std::optional<inference::Estimate> estimate;
  std::optional<inference::Posterior> posterior;      ///< present if the event was sampled
  std::vector<finite_fault::LocalState> along_fault;  ///< subfaults of a finite-fault model, if requested
  std::optional<finite_fault::FaultPulse> pulse;      ///< pulse along its slip distribution, if requested
  std::string error;                                  ///< one line; empty if there is an estimate
  finite_fault::FasterThanC faster_than_c = {};       ///< subfaults that rupture faster than c
  Frictionless frictionless = {};                     ///< before the posterior replaced the estimate

  /// The warnings of the closed forms, then the notes of the posterior.
  std::vector<std::string> warnings() const;
};

/// Evaluations of an event in addition to the closed forms.
struct EvaluationOptions {
  inference::Sampling sampling;  ///< with 0 samples, no event is sampled
  bool sample_all = false;       ///< if false, sample only events with errors or with observations of friction
  bool along_fault = false;      ///< apply the closed forms to each subfault
  bool pulse = false;            ///< compute a pulse along the slip distribution of a finite-fault model
};

/// Evaluates an entry. It never throws InputError; the result contains the error instead.
EventResult evaluate(catalogue::Entry&& entry, const medium::Defaults& defaults, const EvaluationOptions& options);

}  // namespace slipfront::results
