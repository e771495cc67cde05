#pragma once
/// \file
/// The observations that the theory predicts, and what a repeated observation of the same fault would give.

#include <array>
#include <span>
#include <string_view>

#include "slipfront/catalogue/observation.hpp"

namespace slipfront::inference {

/// An observation that the theory predicts. Its name is its key in a file.
struct ObservedQuantity {
  std::string_view name, long_name;
  std::string_view unit;  ///< SI unit; "1" for a pure number
};

/// One number of each observation, in the order of observed_quantities(). NaN if there is none.
using ObservedValues = std::array<double, 7>;

std::span<const ObservedQuantity> observed_quantities();
/// The position of an observation, by its name. \throws std::out_of_range if there is none of this name.
std::size_t position_of(std::string_view name);
/// The middles of the observed numbers.
ObservedValues observed_values(const catalogue::Observation& observation);

/// A repeated observation of the true value x, with the error of `measured`. It is the quantile of `probability`, in
/// 0 ... 1, of all repeated observations. An exact observation repeats x.
double repeated(const catalogue::Measured& measured, double x, double probability);

}  // namespace slipfront::inference
