#pragma once
/// \file
/// Numbers of an event besides the quantities of its fault's state, and what a population sums up.

#include <optional>
#include <span>
#include <vector>

#include "catalogue/population.hpp"
#include "results/evaluate.hpp"
#include "slipfront/description.hpp"
#include "slipfront/inference/quantities.hpp"

namespace slipfront::results {

/// One number of an event, declared once for all outputs.
struct EventNumber {
  Description about;
  bool in_population;  ///< a population sums it up
  std::optional<double> (*get)(const EventResult&);
};
/// In the order of output: before the quantities of the state.
std::span<const EventNumber> event_numbers();

/// The answers of an event, and then lower bounds: a quantity and its value, absent where there is none.
std::optional<inference::Inferred> answer_of(const EventResult& result, const inference::Quantity& quantity);

/// What a population sums up: measured and inferred quantities, in the order of output.
std::vector<Description> population_quantities();
/// An event as a member of a population: its value of each of them. None of an event without a rupture velocity.
std::optional<catalogue::Member> member_of(const EventResult& result);

}  // namespace slipfront::results
