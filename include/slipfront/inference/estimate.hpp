#pragma once
/// \file
/// From what was observed of an event to the state of its fault, by the frictionless relations (Eqs. 8-10).

#include <optional>
#include <string>
#include <vector>

#include "slipfront/catalogue/observation.hpp"
#include "slipfront/inference/quantities.hpp"
#include "slipfront/medium/constants.hpp"

namespace slipfront::inference {

/// State of the fault by the closed forms. Absent means not identifiable from what was observed; a warning says what is
/// missing.
struct Estimate : FaultQuantities<std::optional<Inferred>> {
  double speed = 0;                                     ///< c, m/s
  std::optional<double> observed_rupture_velocity_m_s;  ///< m/s, middle of what was observed, like the next
  std::optional<double> observed_slip_velocity_m_s;     ///< m/s
  std::vector<std::string> warnings;
};

/// \throws InputError (with the observation's file and line) for constants out of range, V >= c, or A above plastic
/// contact. Where the event `is_sampled`, an error that may reach below is a warning instead: the samples decide.
Estimate estimate(const catalogue::Observation& observation, const medium::Defaults& defaults, bool is_sampled = false);

}  // namespace slipfront::inference
