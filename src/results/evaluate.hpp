#pragma once
/// \file
/// Entries of a file put through the theory, and the names of what comes out.

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

/// One event of a file, after the theory: an estimate or the reason why there is none.
struct EventResult {
  catalogue::Observation observation;
  /// One answer: by the closed forms at the middle of what was observed; where the event was sampled and the samples
  /// suffice, the median and the interval of the posterior.
  std::optional<inference::Estimate> estimate;
  std::optional<inference::Posterior> posterior;      ///< where the event was sampled
  std::vector<finite_fault::LocalState> along_fault;  ///< of a finite-fault model, if asked for
  std::optional<finite_fault::FaultPulse> pulse;      ///< through its slip distribution, if asked for
  std::string error;                                  ///< one line; empty when there is an estimate

  /// Those of the closed forms, then what the samples say.
  std::vector<std::string> warnings() const;
};

/// What is done with an event besides the closed forms.
struct EvaluationOptions {
  inference::Sampling sampling;  ///< no samples: none
  bool sample_all = false;       ///< sample all events, or those that speak of friction or of their errors
  bool along_fault = false;      ///< the closed forms subfault by subfault
  bool pulse = false;            ///< a pulse through the slip distribution of a finite-fault model
};

/// Never throws InputError: what is wrong with the entry is in the result.
EventResult evaluate(catalogue::Entry&& entry, const medium::Defaults& defaults, const EvaluationOptions& options);

}  // namespace slipfront::results
