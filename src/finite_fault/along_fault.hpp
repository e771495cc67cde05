#pragma once
/// \file
/// Infers the stress along a fault from a finite-fault model, with the closed forms for each subfault.

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "slipfront/inference/estimate.hpp"

namespace slipfront::finite_fault {

/// The state at one subfault. A quantity is absent if the model does not determine it there.
struct LocalState {
  catalogue::Subfault subfault;
  double along_strike = 0;                          ///< m, from the middle of its segment
  double down_dip = 0;                              ///< m, from the middle of its segment, positive downwards
  std::optional<double> rupture_velocity_m_s = {};  ///< 1 / |gradient of the rupture times| over its neighbours
  std::optional<double> slip_velocity_m_s = {};     ///< slip / rise time
  std::optional<double> stress = {};                ///< Sigma-, in mu A / pi; only if the rupture velocity is below c
  std::optional<double> contact_ratio = {};         ///< A without friction, a lower bound
  std::optional<double> stress_pa = {};             ///< Pa, without friction
};

/// Returns all subfaults of an event, in the order of the file. There are none if the file does not give their
/// positions. The elastic constants are those of the event. \throws InputError for constants out of range.
std::vector<LocalState> along_fault(const catalogue::Observation& observation, const medium::Defaults& defaults);

/// Subfaults whose rupture velocity is above c, where the theory has no pulse.
struct FasterThanC {
  std::size_t subfaults = 0;  ///< their number
  std::size_t timed = 0;      ///< number of subfaults with a rupture velocity
  double moment_share = 0;    ///< their fraction of the moment
};
FasterThanC faster_than(const std::vector<LocalState>& states, double speed);

/// One line that reports them. It is empty if there are none.
std::string warning_of(const FasterThanC& faster, double speed);

}  // namespace slipfront::finite_fault
