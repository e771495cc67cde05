#pragma once
/// \file
/// What was observed of one slip event, in SI units, before any theory is applied.

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "slipfront/catalogue/measured.hpp"
#include "slipfront/error.hpp"
#include "slipfront/friction_ratio/table.hpp"
#include "slipfront/medium/constants.hpp"

namespace slipfront::catalogue {

/// What the slip velocity of an event is, of the model's.
using friction_ratio::Measure;

/// A constant of the medium that was stated with an error; the constant itself holds the middle.
struct UncertainConstant {
  std::optional<double> medium::Constants::*member;
  Measured measured;
};

/// One patch of a finite-fault model. Absent: no such column, or a placeholder.
struct Subfault {
  std::size_t segment = 0;
  double x = 0, y = 0, z = 0;               ///< m, z downwards
  double slip = 0;                          ///< m
  std::optional<double> rise_time = {};     ///< s
  std::optional<double> rupture_time = {};  ///< s, when it began to slip
};

/// One event as its file gives it. Everything is optional but the name: absent means not observed.
struct Observation : medium::Constants {
  std::string name;
  std::string date;
  std::string kind;      ///< "earthquake", "slow slip", ... free text
  std::string citation;  ///< published source of the numbers
  std::string note;      ///< what the source says to mind, free text
  std::string file;      ///< where it was read
  std::size_t line = 0;  ///< line of the row, table or header in that file

  std::optional<Measured> rupture_velocity_m_s;
  std::optional<Measured> slip_velocity_m_s;
  std::optional<Measured> slip;       ///< m
  std::optional<Measured> rise_time;  ///< s, time that one point slips
  std::optional<Measured> duration;   ///< s, of the whole event

  std::optional<Measured> stress_drop;           ///< Pa, mu A Sigma- / pi: all that was stored
  std::optional<Measured> friction_coefficient;  ///< C
  std::optional<Measured> normal_stress;         ///< Pa
  std::optional<Measured> hardness;              ///< Pa; contact_ratio = A_plastic normal_stress / hardness
  std::vector<Subfault> subfaults;               ///< of a finite-fault model that gives their places
  std::optional<Measure> slip_velocity_is;       ///< as stated; see measure()
  std::vector<UncertainConstant> uncertain_constants;

  std::vector<std::string> warnings;  ///< what the reader had to assume or leave out

  /// The time that slip is divided by where no slip velocity was measured; null: none.
  const Measured* slip_time() const {
    if (slip_velocity_m_s || !slip) return nullptr;
    return rise_time ? &*rise_time : duration ? &*duration : nullptr;
  }
  bool has_slip_velocity() const { return slip_velocity_m_s || slip_time(); }
  /// T of Gamma = C T; null: unknown.
  const Measured* damping_time() const { return duration ? &*duration : rise_time ? &*rise_time : nullptr; }
  /// What the slip velocity is taken for where nobody says: slip over a time is the mean over that time.
  Measure measure() const { return slip_velocity_is.value_or(slip_time() ? Measure::time_mean : Measure::origin); }
};

/// One entry of a file: an observation, or the reason why it is none. A bad entry does not lose its neighbours.
struct Entry {
  Observation observation;
  std::optional<Complaint> error;
};

}  // namespace slipfront::catalogue
