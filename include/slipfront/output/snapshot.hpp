#pragma once
/// \file
/// What a pulse run yields at one output time.

#include <functional>
#include <map>
#include <string>
#include <vector>

namespace slipfront::output {

/// When and where to look at a run.
struct Schedule {
  std::vector<double> times;    ///< ascending, from 0; a snapshot each
  std::vector<double> x_edges;  ///< output grid
  double threshold = 1e-3;      ///< of the observed fronts, as a share of the peak slip velocity
};

/// Averaged fields on the scenario's output grid, cell by cell; all dimensionless (docs/NOTATION.md).
struct Profile {
  std::vector<double> k;     ///< dislocation density = stress Sigma
  std::vector<double> U;     ///< velocity of the dislocations, 0 where there are none
  std::vector<double> W;     ///< slip velocity, at the centre; |W| <= k
  std::vector<double> H;     ///< energy density
  std::vector<double> slip;  ///< slip since t = 0 (u, in b / 2 pi)
};

/// Fronts at one time. NaN where there is no such front, or where it has left the domain. The trailing front runs into
/// the more stressed side, the left one if both are alike; the leading front into the other. Where neither end of the
/// domain is stressed there is no trailing front.
struct Fronts {
  double trailing;  ///< fast front: where the slip velocity first departs from that ahead of it
  double leading;   ///< slow front: the free edge, or where the slip velocity falls through half of its largest
  double trailing_characteristic;  ///< place that the fast front would have if its foot moved as a characteristic
  double trailing_observed;        ///< where |W| first exceeds the observer's threshold, from the stressed side
  double leading_observed;         ///< and from the other
};

/// What an observer with a threshold sees: the outermost places, from the left and from the right, where `speed`
/// (|W| at `x`, ascending) passes `level`; `left` or `right` where already the first or last of them moves. NaN where
/// nothing does.
struct Observed {
  double left, right;
};
Observed observed_fronts(const std::vector<double>& x, const std::vector<double>& speed, double level, double left,
                         double right);

/// Energy over the domain per unit width, in units of the scenario (H of docs/theory.md 3.2).
struct Energy {
  double elastic;       ///< of the state at rest with the same density
  double kinetic;       ///< H less that
  double dissipated;    ///< by friction since t = 0
  double supplied;      ///< by the forcing F since t = 0
  double through_ends;  ///< come in through the ends of the domain since t = 0; NaN for a chain
  double shocks;        ///< lost where trains run into each other since t = 0: what closes the budget; NaN for a chain
  double phonons;       ///< of a chain, H less that of the uniform train with the same k and W; NaN for other runs
};

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
  std::map<std::string, double, std::less<>> further = {};  ///< by the names of further_scalars()
};

}  // namespace slipfront::output
