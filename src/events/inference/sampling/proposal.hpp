#pragma once
/// \file
/// The pulse that an observer sees: its state at a given velocity of the observed front and a given damping number.

#include <cstddef>
#include <cstdint>
#include <vector>

#include "slipfront/events/catalogue/observation.hpp"
#include "slipfront/friction/ratio/table.hpp"
#include "slipfront/theory/rupture/relations.hpp"

namespace slipfront::inference {

/// A pulse at one damping number. Velocities are in units of c, stress in mu A / pi, slip velocity in c A / pi.
struct PulseState {
  double rupture_velocity;  ///< |V-|
  double stress;            ///< Sigma-
  double frictionless;      ///< W(0) without friction
  double W;                 ///< the slip velocity that was observed, see Measure
  double drop_share;        ///< the stress drop that was observed over Sigma-, see StressDropIs
  double slope;             ///< d ln |V-| / d ln(observed velocity) at constant damping number
};

/// W without friction. For every measure except the mean over the fault, it is W(0) of the closed form. The mean is a
/// fraction of W(0), which the table has for 0.05 <= Sigma- <= 3. Outside this range we use the value at its end.
double frictionless(catalogue::SlipVelocityKind measure, double stress, double W_at_origin);

/// The relation between the observed quantities of a pulse and its state, for one event. Damping numbers are given as
/// u = ln(1 + Gamma).
class PulseModel {
 public:
  PulseModel(const catalogue::Observation& observation, friction::Closure closure);

  /// The range of observed velocities, without friction, in which the table of friction has the stress.
  double least_seen() const { return least_seen_; }
  double most_seen() const { return most_seen_; }
  /// Largest u, at most ln(1 + most_damping_number), at which a pulse with |V-| < c is seen at velocity `seen`. It is
  /// negative if there is none.
  double most_u(double seen) const;
  /// The pulse that is seen at velocity `seen` (in c) under u <= most_u(seen).
  PulseState at(double seen, double u) const;
  /// (Sigma- - Sigma(0)) / Sigma-, the static stress drop of a pulse in the table of friction.
  double static_share(double stress, double u) const;
  /// The pulse that is seen at this velocity without friction. Its stress may lie outside the table.
  PulseState without_friction(double seen) const;
  /// Returns a pulse of the prior, which is uniform in ln |V-|: `share` = 0 is the slowest and 1 the fastest. Its
  /// stress is in the range of the table.
  PulseState of_prior(double share, double u) const;
  /// The velocity at which the pulse of this stress is seen without friction, in c.
  double seen_without_friction(double stress) const;
  /// The velocity at which this pulse is seen, in c.
  double seen(const PulseState& pulse, double u) const;

 private:
  PulseState state(const rupture::Relations& relations, double slope, double damping) const;
  double drop_share(double stress, double damping) const;

  catalogue::SlipVelocityKind measure_;
  friction::Closure closure_;
  bool sees_front_, static_drop_;
  friction_ratio::FrontCurve front_;
  /// The value of most_u if there is no pulse.
  static constexpr double no_pulse = -1;
  double least_psi_, most_psi_, least_seen_, most_seen_;
  double least_ln_V_, most_ln_V_;
};

/// Points of the Sobol sequence in the open unit cube, moved by a digital shift that a seed makes.
class ShiftedSobol {
 public:
  static constexpr std::size_t dimensions = 16;
  ShiftedSobol(std::size_t points, std::uint64_t seed);
  /// Makes room for more points; those there stay the same.
  void grow(std::size_t points);
  /// Coordinate `dimension` of a point.
  double operator()(std::size_t point, std::size_t dimension) const;

 private:
  const std::vector<std::uint64_t>* points_;
  std::uint64_t shift_[dimensions];
};

/// A seed for one event, from that of the run and the observed numbers. Events with the same numbers have the same
/// seed, whatever their names and their positions in a file.
std::uint64_t seed_of(std::uint64_t seed, const catalogue::Observation& observation);

}  // namespace slipfront::inference
