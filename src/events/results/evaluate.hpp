#pragma once
/// \file
/// Applies the theory to the entries of a file. Also estimates the memory and the disk space that the events of a
/// catalogue need, and stores the parts of a result that take time to compute, so that an interrupted catalogue can
/// resume.

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "events/finite_fault/along_fault.hpp"
#include "slipfront/description.hpp"
#include "slipfront/events/inference/estimate.hpp"
#include "slipfront/events/inference/posterior.hpp"

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

/// Bytes of memory to evaluate `events` events, `at_once` of them at a time, and to store their results.
double memory_needed(const EvaluationOptions& options, std::size_t events, int at_once);
/// Bytes of the file of these results, which is created in memory.
double disk_needed(const EvaluationOptions& options, std::size_t events);
/// \throws InputError if this needs more memory than this process may have. The error states both numbers.
void require_memory(const EvaluationOptions& options, std::size_t events, int at_once, bool with_file = false);

/// The parts of a result that take time to compute. The rest follows quickly from its entry.
struct SavedResult {
  std::optional<inference::Posterior> posterior = {};
  std::optional<finite_fault::FaultPulse> pulse = {};
  std::string error = {};
};

/// Evaluates an entry with the saved parts of its result. The result is identical to that of the first evaluation.
EventResult evaluate(catalogue::Entry&& entry, const medium::Defaults& defaults, const EvaluationOptions& options,
                     SavedResult&& found);

/// The saved parts of these results.
std::string serialize(std::span<const EventResult> results);

/// Reads the output of `serialize`. \throws InputError if `saved` is not such output.
std::vector<SavedResult> deserialize(std::string_view saved);

}  // namespace slipfront::results
