#pragma once
/// \file
/// Slip events of a run. Files, tables, JSON and Python all use the quantities declared here.

#include <limits>
#include <span>
#include <string_view>
#include <vector>

#include "slipfront/description.hpp"

namespace slipfront::output {

/// One slip event of a chain, which is divided into equal parts (docs/loading.md). It is connected in x and t. It
/// begins when the mean slip velocity of a part exceeds a threshold, and parts next to those that move join it. It ends
/// when the velocities of all its parts are below half the threshold.
struct SlipEvent {
  double onset = 0, duration = 0;  ///< `duration` of an event in progress is that so far
  double slip = 0;                 ///< mean over the chain, without slip in other events
  double largest_slip = 0;         ///< slip of the part that slips most
  double load = 0;                 ///< mean force that loads a site, or stress at a pulled end, before the event
  double stress_drop = 0;          ///< fall of the mean force that loads a site, or of the stress at a pulled end
  double peak_velocity = 0;        ///< largest mean slip velocity of a part
  double origin = 0;               ///< x of the part that moved first; NaN if all moved at once
  double length = 0;               ///< total length of the parts that moved
  /// |dx / dt| of the front, by least squares through the parts that moved, from `origin` or from the origin of an
  /// event that it has met; on a ring by the shorter way. NaN if fewer than three parts moved, if all moved at once, or
  /// if the fit is faster than c.
  double rupture_velocity = std::numeric_limits<double>::quiet_NaN();
  double complete = 0;  ///< 1, or 0 if the run ended during the event
  double merged = 0;    ///< number of other events that it has met; they are part of it
};

/// One slip event at the positions of FrontRecords.
struct FrontRecord {
  std::vector<double> arrival;   ///< time at which the slip velocity first exceeds the threshold; NaN: it never does
  std::vector<double> stress;    ///< shear stress -u_x when the event begins
  std::vector<double> traction;  ///< force of friction and substrate on a site when the event begins
};

/// When each slip event arrives at evenly spaced positions of a chain. Empty unless the scenario asks for it.
struct FrontRecords {
  std::vector<double> x;  ///< the middle of each position's share of the chain
  std::vector<FrontRecord> events;
};

/// The members of FrontRecord. `about.name` is the name in files.
std::span<const MemberArray<FrontRecord>> front_columns();
extern const Description front_position;  ///< describes FrontRecords::x

/// A member of SlipEvent, with its description. `about.name` is its name in files.
struct SlipEventColumn {
  Description about;
  double SlipEvent::*value;

  std::string_view key() const;  ///< the name in JSON, where a list of events has it
};
std::span<const SlipEventColumn> slip_event_columns();
/// The columns in which an event has no value.
std::vector<SlipEventColumn> columns_without_value(const std::vector<SlipEvent>& events);

/// The series of events of a run. A median is over the complete events, and NaN without one.
struct EventSeries {
  long count = 0;
  double recurrence_time = 0;  ///< median time between the onsets of successive events; NaN with fewer than two
  double stress_drop = 0;      ///< median; its unit is that of an event
  double peak_velocity = 0;    ///< median
};
EventSeries series_of(const std::vector<SlipEvent>& events);

/// The unit of load and stress drop: of the force on the sites, or of the stress at a `pulled_end`.
std::string_view unit_of_load(bool pulled_end);
/// The description of a column, with that unit.
Description description_of(const SlipEventColumn& column, bool pulled_end);

}  // namespace slipfront::output
