#pragma once
/// \file
/// The slip of a finite-fault model as the initial state of a rupture on a plane, and one side of its hypocentre, where
/// a load holds the stress until the pulse comes.
///
/// The columns of a finite-fault model along strike, and several sources of one earthquake, with what to say where they
/// disagree (docs/events.md).

#include <string>
#include <vector>

#include "averages/pulse/solver.hpp"
#include "events/finite_fault/along_fault.hpp"
#include "events/finite_fault/source/source.hpp"
#include "slipfront/events/inference/estimate.hpp"

namespace slipfront::finite_fault {

/// Smallest stress that the solver supports. Smaller values are treated as zero.
inline constexpr double least_stress = 0.005;

/// The stress (mu A / pi) at given distances from the hypocentre, which ascend from 0. The stress is linear between
/// them, and constant after the last.
struct SideStress {
  std::vector<double> distance, stress;
  double at(double distance) const;
};

/// One side on fine nodes, which extend as far as its front can come by the time `end`.
class HeldSide {
 public:
  HeldSide(SideStress stress, double end);
  /// The time at which the front comes to this distance. It moves with the local speed c0(psi) of Eq. 8, because the
  /// state ahead is at rest. The time is infinite if the stress is zero anywhere on the way.
  double front_time(double distance) const;
  /// The stressed side lies at x < 0. The load F(x) = p_x / k keeps it at rest: P_t + Q_x = F k with U = 0, Q = p.
  pulse::Problem problem() const;

 private:
  SideStress stress_;
  double length_ = 0, node_ = 0;         ///< distance of the last node, spacing of the nodes
  std::vector<double> pressure_, time_;  ///< pressure and front time at the nodes
};

/// The segment of the hypocentre as a grid, row by row from the lowest row upwards. x is along strike and y up dip, in
/// m from the hypocentre.
struct OnPlane {
  std::vector<double> x, y;  ///< ascending
  double cell_length = 0, cell_width = 0;
  std::vector<double> slip, rupture_time;  ///< slip (m) and rupture time (s) of each cell
  double end = 0;                          ///< s, when the last subfault has slipped
  double moment = 0;                       ///< N m, of this segment
  double largest_slip = 0;                 ///< m
  double largest_gradient = 0;             ///< largest gradient of the slip
  double mean_gradient = 0;                ///< its mean, weighted by slip
  std::string note;                        ///< one sentence if other segments are left out

  std::size_t at(std::size_t i, std::size_t j) const { return j * x.size() + i; }
};
OnPlane on_plane(const FiniteSource& source);

/// The mean slip from which a rupture makes the slip D of the model: U = D_max - D, which is flat where nothing slips.
/// A margin around the model does not slip. Rows of x (m), y (m) and U (m).
std::vector<std::vector<double>> slip_to_come(const OnPlane& fault, double margin);

/// Moment rate of a source on a grid of times that begins at 0, in N m / s.
std::vector<double> moment_rate(const FiniteSource& source, double interval, std::size_t count);

/// A column: the subfaults at one position along strike.
struct FaultColumn {
  double x;             ///< m along strike, from the hypocentre
  double slip;          ///< m, mean over depth, >= 0
  double rupture_time;  ///< s since the rupture began, at the first subfault that slips; NaN if none does
};

struct FaultColumns {
  std::vector<FaultColumn> columns;  ///< ascending in x; empty if there is a `reason`
  double end = 0;                    ///< s since the rupture began, when the last subfault has slipped (TRUP + RISE)
  std::string reason;                ///< one line that states why there are no columns
};

/// The columns of the segment on which the rupture begins. The hypocentre is the position of the earliest rupture
/// times. Rupture times of subfaults that slip less than 5 % of the largest slip are ignored.
FaultColumns columns_of(const std::vector<LocalState>& states);

/// Sources disagree where the largest stress in Pa, or bound of it, is more than this many times the smallest.
inline constexpr double most_disagreement = 2;

/// Adds a warning to each entry where sources of its earthquake disagree. Two entries are one earthquake if they have
/// the same folder; or the same day and the same first word in their names; where only the year is known, the same year
/// and the same name.
void warn_of_other_sources(std::vector<catalogue::Entry>& entries, const medium::Defaults& defaults);

}  // namespace slipfront::finite_fault
