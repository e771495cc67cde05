#pragma once
/// \file
/// From what was observed of an event to the state of its fault, by the frictionless relations (Eqs. 8-10).

#include <optional>
#include <string>
#include <vector>

#include "slipfront/catalogue/observation.hpp"
#include "slipfront/medium/elastic.hpp"

namespace slipfront::inference {

/// [5 %, 95 %] of an inferred quantity.
struct Interval {
  double low;
  double high;
};

/// An inferred number. By the closed forms `interval` is there when exactly one observed error moves it (a range is
/// read as uniform): every inferred quantity is monotone in each observed one, so its quantiles are those of the
/// observed one, exactly. Where the event is sampled, see EventResult.
struct Inferred {
  double value;
  std::optional<Interval> interval;
};

/// State of the fault. Absent means not identifiable from what was observed; a warning says what is missing.
struct Estimate {
  double speed = 0;                                    ///< c, m/s
  std::optional<double> observed_rupture_velocity;     ///< m/s
  std::optional<double> observed_slip_velocity_m_s;    ///< m/s
  std::optional<Inferred> rupture_velocity;            ///< V / c
  std::optional<Inferred> stress;                      ///< Sigma-, in mu A / pi
  std::optional<Inferred> frictionless_slip_velocity;  ///< W(0) without friction, in c A / pi
  std::optional<Inferred> observed_slip_velocity;  ///< in c A / pi; needs a contact ratio that is given, not inferred
  std::optional<Inferred> slip_velocity_ratio;     ///< observed over frictionless; 1 - ratio is what friction took
  std::optional<Inferred> contact_ratio;           ///< A: given, or pi w / (c W(0)) as if there were no friction
  std::optional<Inferred> stress_pa;               ///< mu A Sigma- / pi, Pa; absent where there is but a bound
  /// Lower bounds, if friction took nothing: of A and the stress in Pa where only velocities are known, of both
  /// stresses where there is a contact ratio and no rupture velocity.
  std::optional<Inferred> stress_bound, contact_ratio_bound, stress_pa_bound;
  std::optional<Inferred> damping_number;        ///< Gamma = C T; needs the posterior, like the next
  std::optional<Inferred> friction_coefficient;  ///< C
  std::vector<std::string> warnings;
};

/// \throws InputError (with the observation's file and line) for constants out of range, V >= c, or A above plastic
/// contact. Where the event `is_sampled`, an error that may reach below is a warning instead: the samples decide.
Estimate estimate(const catalogue::Observation& observation, const medium::Defaults& defaults, bool is_sampled = false);

}  // namespace slipfront::inference
