#pragma once
/// \file
/// Computes a pulse along the slip distribution of a finite-fault model. The slip gives the stress along strike. The
/// frictionless modulation equations then give front and slip, to be compared with the model. docs/events.md lists the
/// assumptions.

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "finite_fault/along_fault.hpp"
#include "foundation/archive.hpp"
#include "slipfront/description.hpp"

namespace slipfront::finite_fault {

/// A pulse along strike. The vectors have an element for each column, in the order of x.
struct FaultPulse {
  std::string reason;          ///< one line that states why there is no pulse; all else is empty then
  std::vector<double> x;       ///< m, from the hypocentre
  std::vector<double> stress;  ///< stress before the rupture, mu A / pi
  std::vector<std::optional<double>> model_time;    ///< s, first rupture time in the column; absent if it hardly slips
  std::vector<std::optional<double>> front_time;    ///< s, when the front arrives; absent if the stress is 0 on its way
  std::vector<double> model_slip;                   ///< m, mean over depth
  std::vector<double> pulse_slip;                   ///< m, at time `end`, times the one factor that fits best
  double end = 0;                                   ///< s, when the last subfault of the model has slipped
  std::size_t reached = 0;                          ///< number of columns that the front reaches by `end`
  std::optional<double> front_velocity_ratio = {};  ///< mean front velocity of the pulse over that of the model
  std::optional<double> correlation_of_slip = {};   ///< Pearson's coefficient over the columns
  std::optional<double> slip_error = {};     ///< largest |slip| ahead of the front (exactly 0) over the largest slip
  std::optional<double> contact_ratio = {};  ///< A from the factor between the slips

  void archive(Archive& a) {
    a(reason, x, stress, model_time, front_time, model_slip, pulse_slip, end, reached, front_velocity_ratio,
      correlation_of_slip, slip_error, contact_ratio);
  }
};

/// A number that summarizes such a pulse.
struct PulseQuantity {
  Description about;
  std::optional<double> (*get)(const FaultPulse&);
  bool is_count = false;
};
std::span<const PulseQuantity> pulse_quantities();

/// Computes the pulse. `stress` is that of the event and `speed` its c in m/s; both must be > 0.
FaultPulse pulse_along_fault(const std::vector<LocalState>& states, double stress, double speed);

/// Initial stress of a column that slips `share` times the slip-weighted mean slip of an event. Its W(0) by the closed
/// form (Eqs. 8-10) is `share` times that of the event, because all columns have one rise time. A stress below 0.005 is
/// set to 0, and a stress above 5 to 5.
double stress_by_slip(double event_stress, double share);

}  // namespace slipfront::finite_fault
