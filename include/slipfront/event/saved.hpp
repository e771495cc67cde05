#pragma once
/// \file
/// What of a result takes time to find, as bytes, for a catalogue that is to go on where it was stopped.

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "slipfront/event/evaluate.hpp"

namespace slipfront::event {

/// The rest of a result follows from its entry at once.
struct Found {
  std::optional<Posterior> posterior = {};
  std::optional<FaultPulse> pulse = {};
  std::string error = {};
};

/// The result of an entry of which this was found before, to the same bits.
EventResult evaluate(Entry&& entry, const MediumDefaults& defaults, const Plan& plan, Found&& found);

/// What was found of these results.
std::string saved(std::span<const EventResult> results);

/// The same, back. \throws InputError where it is not what `saved` made.
std::vector<Found> found_in(std::string_view saved);

}  // namespace slipfront::event
