#pragma once
/// \file
/// Infers the stress along a fault from a finite-fault model, with the closed forms for each subfault.
/// Computes a pulse along the slip distribution of a finite-fault model. The slip gives the stress along strike. The
/// frictionless modulation equations then give front and slip, to be compared with the model. docs/events.md lists the
/// assumptions.

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "slipfront/description.hpp"
#include "slipfront/events/inference/estimate.hpp"
#include "system/archive.hpp"

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
