#pragma once
/// \file
/// Infers the state of a fault from the observations of an event, with the frictionless relations (Eqs. 8-10).
/// Also the observations that the theory predicts, and what a repeated observation of the same fault would give.

#include <array>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "slipfront/events/catalogue/observation.hpp"
#include "slipfront/events/inference/quantities.hpp"
#include "slipfront/theory/medium/constants.hpp"

namespace slipfront::inference {

/// The state of the fault by the closed forms. A quantity is absent if the observations do not determine it. A warning
/// then names the missing observation.
struct Estimate : InferredQuantities {
  double speed = 0;                                     ///< c, m/s
  std::optional<double> observed_rupture_velocity_m_s;  ///< m/s, middle of the observed range, like the next
  std::optional<double> observed_slip_velocity_m_s;     ///< m/s
  std::vector<std::string> warnings;
};

/// \throws InputError (with the observation's file and line) for constants out of range, V >= c, or A above plastic
/// contact. If the event `is_sampled` and the observational error reaches below the limit, the estimate warns instead,
/// because the samples decide.
Estimate estimate(const catalogue::Observation& observation, const medium::Defaults& defaults, bool is_sampled = false);

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
double repeated(const catalogue::MeasuredValue& measured, double x, double probability);

}  // namespace slipfront::inference
