#pragma once
/// \file
/// Stores, as bytes, the parts of a result that take time to compute, so that an interrupted catalogue can resume.

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "results/evaluate.hpp"

namespace slipfront::results {

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
