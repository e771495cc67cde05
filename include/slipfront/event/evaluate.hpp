#pragma once
/// \file
/// Entries of a file put through the theory, and the names of what comes out.

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "slipfront/description.hpp"
#include "slipfront/event/estimate.hpp"

namespace slipfront::event {

/// One event of a file, after the theory: an estimate or the reason why there is none.
struct EventResult {
  Observation observation;
  std::optional<Estimate> estimate;
  std::string error;  ///< one line; empty when there is an estimate

  const std::vector<std::string>& warnings() const { return estimate ? estimate->warnings : observation.warnings; }
};

/// Never throws InputError: what is wrong with the entry is in the result.
EventResult evaluate(Entry&& entry, const MediumDefaults& defaults);

/// The constants of the medium as a user states them, such as "6 km/s", 0.3 and "30 GPa"; empty: the default.
struct StatedMedium {
  std::string p_wave_speed, poisson_ratio, shear_modulus;
};
/// \throws InputError that names the option.
MediumDefaults defaults_of(const StatedMedium& stated);

/// Members of Estimate by name, in the order of output.
template <class T>
struct EstimateQuantity {
  Description about;
  std::optional<T> Estimate::*value;
};
std::span<const EstimateQuantity<double>> measured_quantities();
std::span<const EstimateQuantity<Inferred>> inferred_quantities();

}  // namespace slipfront::event
