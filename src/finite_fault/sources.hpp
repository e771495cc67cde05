#pragma once
/// \file
/// Several sources of one earthquake, and what to say where they disagree (docs/events.md).

#include <vector>

#include "slipfront/inference/estimate.hpp"

namespace slipfront::finite_fault {

/// Sources disagree where the largest stress in Pa, or bound of it, is more than this many times the smallest.
inline constexpr double most_disagreement = 2;

/// Adds a warning to each entry where sources of its earthquake disagree. Two entries are one earthquake if they have
/// the same day and the same first word in their names; where only the year is known, the same year and the same name.
void warn_of_other_sources(std::vector<catalogue::Entry>& entries, const medium::Defaults& defaults);

}  // namespace slipfront::finite_fault
