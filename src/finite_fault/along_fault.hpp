#pragma once
/// \file
/// Stress along the fault from a finite-fault model: the closed forms subfault by subfault.

#include <optional>
#include <vector>

#include "slipfront/inference/estimate.hpp"

namespace slipfront::finite_fault {

/// One subfault. Absent: not identifiable there.
struct LocalState {
  catalogue::Subfault subfault;
  double along_strike = 0;                          ///< m, from the middle of its segment
  double down_dip = 0;                              ///< m, likewise, downwards
  std::optional<double> rupture_velocity_m_s = {};  ///< 1 / |gradient of the rupture times| over its neighbours
  std::optional<double> slip_velocity_m_s = {};     ///< slip / rise time
  std::optional<double> stress = {};                ///< Sigma-, in mu A / pi; where the rupture velocity is below c
  std::optional<double> contact_ratio = {};         ///< as if there were no friction: a lower bound
  std::optional<double> stress_pa = {};             ///< Pa, likewise
};

/// All subfaults of an event, in the file's order; none where the file does not give their places. Elastic constants
/// are those of the event. \throws InputError for constants out of range.
std::vector<LocalState> along_fault(const catalogue::Observation& observation, const medium::Defaults& defaults);

}  // namespace slipfront::finite_fault
