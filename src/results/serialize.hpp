#pragma once
/// \file
/// What of a result takes time to find, as bytes, for a catalogue that is to go on where it was stopped.

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "results/evaluate.hpp"

namespace slipfront::results {

/// The rest of a result follows from its entry at once.
struct SavedResult {
  std::optional<inference::Posterior> posterior = {};
  std::optional<finite_fault::FaultPulse> pulse = {};
  std::string error = {};
};

/// The result of an entry of which this was found before, to the same bits.
EventResult evaluate(catalogue::Entry&& entry, const medium::Defaults& defaults, const EvaluationOptions& options,
                     SavedResult&& found);

/// What was found of these results.
std::string serialize(std::span<const EventResult> results);

/// The same, back. \throws InputError where it is not what `saved` made.
std::vector<SavedResult> deserialize(std::string_view saved);

}  // namespace slipfront::results
