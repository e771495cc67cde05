#pragma once
/// \file
/// Quantities of an event by their names.

#include <optional>
#include <span>
#include <vector>

#include "slipfront/catalogue/population.hpp"
#include "slipfront/description.hpp"
#include "slipfront/results/evaluate.hpp"

namespace slipfront::results {

/// Members of Estimate by name, in the order of output.
template <class T>
struct EstimateQuantity {
  Description about;
  std::optional<T> inference::Estimate::*value;
};
std::span<const EstimateQuantity<double>> measured_quantities();
std::span<const EstimateQuantity<inference::Inferred>> inferred_quantities();
std::span<const EstimateQuantity<inference::Inferred>> bound_quantities();  ///< lower bounds, if friction took nothing

/// Members of Posterior by name, likewise.
struct PosteriorQuantity {
  Description about;
  std::optional<catalogue::Quantiles> inference::Posterior::*value;
};
std::span<const PosteriorQuantity> posterior_quantities();

/// What a population sums up: the measured and the inferred quantities, in the order of output.
std::vector<Description> population_quantities();
/// An event as a member of a population: its value of each of them. None of an event without a rupture velocity.
std::optional<catalogue::Member> member_of(const EventResult& result);

}  // namespace slipfront::results
