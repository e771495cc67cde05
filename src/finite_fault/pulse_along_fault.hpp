#pragma once
/// \file
/// A pulse through the slip distribution of a finite-fault model: stress along strike from slip, the frictionless
/// modulation equations on it, and its front and slip beside the model's. Assumptions: docs/events.md.

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "finite_fault/along_fault.hpp"
#include "slipfront/description.hpp"

namespace slipfront::finite_fault {

/// One entry a column along strike, in the order of x.
struct FaultPulse {
  std::string reason;                               ///< one line, why there is no pulse; then all else is empty
  std::vector<double> x;                            ///< m, from the hypocentre
  std::vector<double> stress;                       ///< before the rupture, mu A / pi
  std::vector<std::optional<double>> model_time;    ///< s, first rupture time in the column; none: it hardly slips
  std::vector<std::optional<double>> front_time;    ///< s, of the pulse's front; none: unstressed on the way
  std::vector<double> model_slip;                   ///< m, mean over depth
  std::vector<double> pulse_slip;                   ///< m, at `end`, times the one factor that fits best
  double end = 0;                                   ///< s, when the model's last subfault has slipped
  std::size_t reached = 0;                          ///< columns that the front reaches by then
  std::optional<double> front_velocity_ratio = {};  ///< of the pulse, over the model's
  std::optional<double> correlation_of_slip = {};   ///< Pearson's, over the columns
  std::optional<double> slip_error = {};     ///< largest |slip| ahead of the front, exactly 0, over the largest slip
  std::optional<double> contact_ratio = {};  ///< A that the factor between slips says
};

/// What such a pulse is summed up by.
struct PulseQuantity {
  Description about;
  std::optional<double> (*get)(const FaultPulse&);
  bool is_count = false;
};
std::span<const PulseQuantity> pulse_quantities();

/// Calls `visit` with each member, always in the same order: for what writes and reads a pulse. `Pulse` may be const.
template <class Visit, class Pulse>
void visit_members(Visit& visit, Pulse& p) {
  visit(p.reason), visit(p.x), visit(p.stress), visit(p.model_time), visit(p.front_time), visit(p.model_slip);
  visit(p.pulse_slip), visit(p.end), visit(p.reached), visit(p.front_velocity_ratio), visit(p.correlation_of_slip);
  visit(p.slip_error), visit(p.contact_ratio);
}

/// `stress` is that of the event, `speed` its c in m/s; both > 0.
FaultPulse pulse_along_fault(const std::vector<LocalState>& states, double stress, double speed);

/// Initial stress where a column slips `share` times the (slip-weighted) mean slip of an event: W(0) of the closed
/// form (Eqs. 8-10) is that share of the event's, for one rise time. 0 where that is below 0.005; at most 5.
double stress_by_slip(double event_stress, double share);

}  // namespace slipfront::finite_fault
