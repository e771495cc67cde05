#pragma once
/// \file
/// Slip events of a run: what is known of each, declared once for files, tables, JSON and Python.

#include <limits>
#include <span>
#include <vector>

#include "slipfront/description.hpp"

namespace slipfront::output {

/// One event: from when the slip velocity of some place rises above a threshold until those of all places have fallen
/// below half of it.
struct SlipEvent {
  double onset = 0, duration = 0;  ///< of an event in progress: so far
  double slip = 0;                 ///< mean over all places
  double largest_slip = 0;         ///< of one place
  double stress_drop = 0;          ///< of the mean force that loads a place, or of the stress at a pulled end
  double peak_velocity = 0;        ///< of one place
  double origin = 0;               ///< x of the place that moved first
  double length = 0;               ///< of the places that moved
  /// |dx / dt| of the front, by least squares through the places that moved, from `origin`. NaN where fewer than three
  /// did, or all at once.
  double rupture_velocity = std::numeric_limits<double>::quiet_NaN();
  double complete = 0;  ///< 1; 0 where the run ended within it
};

/// About a member, by the name that it has in files and JSON.
struct SlipEventColumn {
  Description about;
  double SlipEvent::*value;
};
std::span<const SlipEventColumn> slip_event_columns();

}  // namespace slipfront::output
