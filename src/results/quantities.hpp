#pragma once
/// \file
/// The numbers of an event that are not quantities of the state of its fault, and the quantities of a population.

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
  bool in_population;  ///< whether population statistics include it
  std::optional<double> (*get)(const EventResult&);
};
/// The numbers in the order of output, in which they precede the quantities of the state.
std::span<const EventNumber> event_numbers();

/// The value of a quantity in the result of an event. It is absent if the quantity has none.
std::optional<inference::Inferred> answer_of(const EventResult& result, const inference::Quantity& quantity);

/// The quantities of population statistics: observed and inferred quantities, in the order of output.
std::vector<Description> population_quantities();
/// The values of these quantities for one event. They are absent for an event without a rupture velocity.
std::optional<catalogue::Member> member_of(const EventResult& result);

}  // namespace slipfront::results
