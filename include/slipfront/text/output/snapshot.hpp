#pragma once
/// \file
/// The results of a run at one output time.

#include <cstddef>
#include <limits>
#include <vector>

namespace slipfront::output {

/// The output times and the output grid of a run.
struct Schedule {
  std::vector<double> times;    ///< ascending, from 0; one snapshot each
  std::vector<double> x_edges;  ///< edges of the cells of the output grid
  std::size_t per_event = 0;    ///< further snapshots of each slip event; 0: none
  bool displacement = false;    ///< whether snapshots of a chain have u at all sites
  bool dislocations = false;    ///< whether they have all dislocations
  double threshold = 1e-3;      ///< slip velocity at an observed front, as a fraction of the peak slip velocity
};

/// Averaged fields on the scenario's output grid, cell by cell; all dimensionless (docs/NOTATION.md).
struct Profile {
  std::vector<double> k;            ///< dislocation density = stress Sigma
  std::vector<double> U;            ///< velocity of the dislocations, 0 where there are none
  std::vector<double> W;            ///< slip velocity at the centre of the cell; |W| <= k
  std::vector<double> H;            ///< energy density
  std::vector<double> slip;         ///< slip since t = 0 (u, in b / 2 pi)
  std::vector<double> trains = {};  ///< number of trains at the centre of the cell; empty unless a run counts them
};

/// Positions x of the fronts at one time. NaN if there is no such front, or if it has left the domain. The trailing
/// front runs into the side with the larger stress, or into the left side if the stresses are equal. The leading front
/// runs into the other side. If neither end of the domain is stressed, there is no trailing front.
struct Fronts {
  double trailing;  ///< fast front: x at which the slip velocity first differs from that ahead of the front
  double leading;   ///< slow front: the free edge, or x at which the slip velocity falls through half of its maximum
  double trailing_characteristic;  ///< x of the fast front if its foot moved along a characteristic
  double trailing_observed;        ///< first x, from the stressed side, at which |W| exceeds the threshold
  double leading_observed;         ///< first x, from the other side, at which |W| exceeds the threshold
};

/// The fronts that an observer with a threshold sees: the first x from the left and from the right at which `speed`
/// (|W| at `x`, ascending) passes `level`. If the first or last of `speed` exceeds it already, that front is `left` or
/// `right`. NaN if none exceeds it.
struct Observed {
  double left, right;
};
Observed observed_fronts(const std::vector<double>& x, const std::vector<double>& speed, double level, double left,
                         double right);

/// Energy over the domain per unit width, in units of the scenario (H of docs/theory/3_modulation.md 3.2).
struct Energy {
  double elastic;       ///< energy of the state at rest with the same density
  double kinetic;       ///< H less `elastic`
  double dissipated;    ///< energy that friction dissipated since t = 0
  double supplied;      ///< energy that the forcing F supplied since t = 0
  double through_ends;  ///< energy that entered through the ends of the domain since t = 0; NaN for a chain
  double shocks;        ///< energy lost where trains ran into each other since t = 0; NaN if none have
  double residual;      ///< rest of the budget since t = 0: `shocks` and errors of the cells; NaN for a chain
  /// H of a chain, less that of the uniform train with the same k and W; NaN without a substrate, and for other runs.
  double phonons;
  double loading = 0;   ///< energy in the springs that load a chain
  double contacts = 0;  ///< energy that contacts supplied as their strength changed
};

/// One dislocation of a chain: u passes (2 level + 1) pi.
struct Dislocation {
  double x;
  int sign;  ///< +1: u falls by 2 pi with x; -1: an antidislocation
  long level;
};
/// Sorts dislocations by x.
void sort(std::vector<Dislocation>& dislocations);

/// The results at one time. Its numbers are declared in quantities.cpp.
struct Snapshot {
  double time;
  Profile profile;
  Fronts fronts;
  Energy energy;
  double slip_velocity_at_origin;
  double stress_at_origin;
  double slip_at_origin;
  double peak_slip_velocity;
  double peak_position;
  double potency = 0;                                                ///< integral of the slip since t = 0 over x
  double loading_force = std::numeric_limits<double>::quiet_NaN();   ///< mean force of springs everywhere on a site
  double loading_stress = std::numeric_limits<double>::quiet_NaN();  ///< stress at the end that a spring pulls
  double pore_pressure_at_origin = 0;                                ///< over the normal stress
  std::vector<double> displacement =
      {};  ///< u at the sites, in the unit of slip; on rank 0, if the schedule asks for it
  std::vector<Dislocation> dislocations = {};  ///< ascending in x, if the schedule asks for them
};

}  // namespace slipfront::output
