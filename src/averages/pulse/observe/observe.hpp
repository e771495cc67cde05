#pragma once
/// \file
/// Measurements of a run at one time: profiles on a fixed grid, fronts, energies.

#include <vector>

#include "averages/pulse/solver.hpp"
#include "averages/pulse/view/view.hpp"
#include "slipfront/text/output/snapshot.hpp"

namespace slipfront::pulse {

/// The characteristic that leaves the outermost change of stress at t = 0 on the more stressed side (the left one if
/// both are equal). Without numerical errors, the trailing edge of the motion would follow it, and without friction it
/// does.
class TrailingCharacteristic {
 public:
  /// Starts where the initial stress first departs from its value at the stressed end by 1 % of its range. For a step
  /// of stress, this is the corner.
  explicit TrailingCharacteristic(const Solver& start);
  /// Follows dx/dt = lambda_- (to the left) or lambda_+ (to the right) over one step, with the state just ahead. It is
  /// exact if that state is uniform and at rest.
  void advance(const Solver& now, double dt);
  double position() const { return position_; }
  bool stressed_left() const { return stressed_left_; }
  /// Continues from a saved position; `now` is the solver as it was then.
  void restore(const Solver& now, double position);

 private:
  double speed_into(const State& ahead) const;
  double speed_at(const Solver& now) const;

  double position_;
  bool stressed_left_;
  bool steady_ = false;  ///< the state ahead stays uniform, so the speed is constant
  double speed_ = 0;     ///< present speed
};

/// Whether there is no stress outside an end of a view.
bool free_at(const View& view, bool right);

/// Position of the leading front, on the less stressed side; NaN if there is none. It is the free edge, or the position
/// at which the slip velocity W (of the cells) falls to half of its maximum. The velocity of dislocations would not do:
/// a shock pushes a few dislocations of a dilute train ahead of itself.
double leading_front(const View& view, const std::vector<double>& W, bool to_right);

/// Position of the trailing front, the foot of the fan on the more stressed side; NaN if there is none. We find the
/// first cell whose slip velocity differs from that at the stressed end by a thousandth of the maximum. A parabola
/// through three cells behind it gives x as a function of the difference, and is extrapolated to zero difference.
///
/// Friction can draw the foot out into a tail. The front is then the position at which the difference reaches a
/// thousandth of the maximum. The same holds for a smooth initial stress (`smooth`), whose fan has no corner: whether
/// cells show one would depend on their number.
double trailing_front(const View& view, const std::vector<double>& W, bool stressed_left, bool smooth);

/// Energy of the interface now. The energy 8 a(x) of each isolated dislocation is summed separately. Without a contact
/// profile it is constant, and rounding of this large number then does not affect small changes of the others.
struct StoredEnergy {
  double isolated;     ///< energy of the dislocations if each were isolated and at rest
  double interaction;  ///< elastic energy in excess of that
  double kinetic;
  double correction;  ///< part of the sums that comes from differences between cells; the truncation error is smaller
  double unresolved;  ///< kinetic energy of cells where it is not smooth, as for a pulse narrower than a cell

  double elastic() const { return isolated + interaction; }
  double all() const { return elastic() + kinetic; }
};
StoredEnergy stored_energy(const Solver& solver);

/// Energies of a snapshot, except `shocks` and `phonons`, which are NaN.
output::Energy energy_of(const Solver& solver, const View& view);

/// Relative error of the number of dislocations, |counted - expected| / expected. We count with Simpson's rule over the
/// densities at the faces and centres of the cells. Expected are the dislocations at t = 0 and those that have entered.
/// The error is that of the states and not only rounding: 1e-6 for smooth profiles with 400 cells, more if shocks or
/// free edges span few cells.
double conservation_error(const Solver& solver);

/// Everything of a snapshot. `x_edges` ascend; `threshold` is the observer's, as a share of the peak slip velocity.
output::Snapshot observe(const Solver& solver, const std::vector<double>& x_edges,
                         const TrailingCharacteristic& trailing, double threshold);

}  // namespace slipfront::pulse
