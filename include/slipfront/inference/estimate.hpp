#pragma once
/// \file
/// Infers the state of a fault from the observations of an event, with the frictionless relations (Eqs. 8-10).

#include <optional>
#include <string>
#include <vector>

#include "slipfront/catalogue/observation.hpp"
#include "slipfront/inference/quantities.hpp"
#include "slipfront/medium/constants.hpp"

namespace slipfront::inference {

/// The state of the fault by the closed forms. A quantity is absent if the observations do not determine it. A warning
/// then names the missing observation.
struct Estimate : FaultQuantities<std::optional<Inferred>> {
  double speed = 0;                                     ///< c, m/s
  std::optional<double> observed_rupture_velocity_m_s;  ///< m/s, middle of the observed range, like the next
  std::optional<double> observed_slip_velocity_m_s;     ///< m/s
  std::vector<std::string> warnings;
};

/// \throws InputError (with the observation's file and line) for constants out of range, V >= c, or A above plastic
/// contact. If the event `is_sampled` and the observational error reaches below the limit, the estimate warns instead,
/// because the samples decide.
Estimate estimate(const catalogue::Observation& observation, const medium::Defaults& defaults, bool is_sampled = false);

}  // namespace slipfront::inference
