#pragma once
/// \file
/// The observations of one slip event, in SI units, before any theory is applied.

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "slipfront/error.hpp"
#include "slipfront/events/catalogue/measured.hpp"
#include "slipfront/friction/ratio/table.hpp"
#include "slipfront/theory/medium/constants.hpp"

namespace slipfront::catalogue {

/// Which slip velocity of the model the observed slip velocity is compared with.
using friction_ratio::SlipVelocityKind;

/// Which velocity the observed rupture velocity is.
enum class RuptureVelocityIs {
  front,           ///< the front that an observer sees: there, W is `front_threshold` of its peak
  characteristic,  ///< |V-|, the speed of the first disturbance, which friction does not change; the paper's reading
};
/// Which stress the observed stress drop is.
enum class StressDropIs {
  static_drop,  ///< stress before minus stress after, at x = 0
  stored,       ///< mu A Sigma- / pi: all the stress that was stored
};

/// "front" or "characteristic"; "static" or "stored". \throws InputError (value, problem, allowed) for another name.
const char* name_of(RuptureVelocityIs meaning);
const char* name_of(StressDropIs meaning);
RuptureVelocityIs rupture_velocity_meaning(std::string_view name);
StressDropIs stress_drop_meaning(std::string_view name);

/// The range of `front_threshold`, and its value if the file does not give it.
inline constexpr double least_front_threshold = 1e-4, most_front_threshold = 0.3, default_front_threshold = 1e-3;
/// Parses a `front_threshold`. \throws InputError (value, problem, allowed).
double parse_front_threshold(std::string_view text);

/// A constant of the medium that was given with an uncertainty. The constant itself holds the central value.
struct UncertainConstant {
  std::optional<double> medium::Constants::*member;
  MeasuredValue measured;
};

/// One patch of a finite-fault model. A value is absent if its column is missing or holds a placeholder.
struct Subfault {
  std::size_t segment = 0;
  double x = 0, y = 0, z = 0;               ///< m, z downwards
  double slip = 0;                          ///< m
  std::optional<double> rise_time = {};     ///< s
  std::optional<double> rupture_time = {};  ///< s, time when the patch began to slip
  double moment_share = 0;                  ///< fraction of the moment of the model
};

/// One event as its file gives it. Only the name is required; an absent value was not observed.
struct Observation : medium::Constants {
  std::string name;
  std::string date;
  std::string kind;      ///< "earthquake", "slow slip", ... free text
  std::string citation;  ///< published source of the numbers
  std::string study;     ///< the study that published them, in populations of several studies
  std::string note;      ///< caveats of the source, free text
  std::string file;      ///< the file that the event was read from
  std::size_t line = 0;  ///< line of the row, table or header in that file

  std::optional<MeasuredValue> rupture_velocity_m_s;
  std::optional<MeasuredValue> slip_velocity_m_s;
  std::optional<MeasuredValue> slip;       ///< m
  std::optional<MeasuredValue> rise_time;  ///< s, time for which one point slips
  std::optional<MeasuredValue> duration;   ///< s, of the whole event

  std::optional<MeasuredValue> rupture_length, rupture_width;  ///< m
  std::optional<MeasuredValue> rupture_area;                   ///< m^2
  std::optional<MeasuredValue> moment;                         ///< N m
  std::optional<MeasuredValue> moment_magnitude;               ///< Mw
  std::vector<Bound> bounds;                                   ///< limits such as "<2.7 km/s", which give no value

  std::optional<MeasuredValue> stress_drop;           ///< Pa; `stress_drop_is` gives its meaning
  std::optional<MeasuredValue> friction_coefficient;  ///< C
  std::optional<MeasuredValue> normal_stress;         ///< Pa
  std::optional<MeasuredValue> hardness;              ///< Pa; contact_ratio = A_plastic normal_stress / hardness
  /// Pa, ahead of a front in the laboratory and behind it. Events have none.
  std::optional<MeasuredValue> shear_stress, shear_stress_after;
  std::vector<Subfault> subfaults;                   ///< patches, if the event is a finite-fault model with coordinates
  std::optional<SlipVelocityKind> slip_velocity_is;  ///< as given in the file; see measure()
  RuptureVelocityIs rupture_velocity_is = RuptureVelocityIs::front;
  StressDropIs stress_drop_is = StressDropIs::static_drop;
  double front_threshold = default_front_threshold;  ///< slip velocity at the observed front, as a fraction of the peak
  std::vector<UncertainConstant> uncertain_constants;

  std::vector<std::string> warnings;  ///< assumptions and omissions that the reader of the file had to make

  /// The time that divides slip to give a slip velocity, if no slip velocity was measured. Null if there is none.
  const MeasuredValue* slip_time() const {
    if (slip_velocity_m_s || !slip) return nullptr;
    return rise_time ? &*rise_time : duration ? &*duration : nullptr;
  }
  bool has_slip_velocity() const { return slip_velocity_m_s || slip_time(); }
  /// T of the damping number Gamma = C T. Null if it is unknown.
  const MeasuredValue* damping_time() const { return duration ? &*duration : rise_time ? &*rise_time : nullptr; }
  /// Meaning of the slip velocity. If the file does not state it, slip over a time is the mean over that time, and a
  /// measured slip velocity is that at the origin.
  SlipVelocityKind measure() const {
    return slip_velocity_is.value_or(slip_time() ? SlipVelocityKind::time_mean : SlipVelocityKind::origin);
  }
};

/// One entry of a file: an observation, or the error in it. An entry with an error does not affect the others.
struct Entry {
  Observation observation;
  std::optional<Complaint> error;
  std::string event = {};  ///< entries with the same text are sources of one event; empty: name and date decide
};

}  // namespace slipfront::catalogue
