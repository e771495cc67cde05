#pragma once
/// \file
/// What is measured of a run at one time: profiles on a fixed grid, fronts, energies.

#include <vector>

#include "slipfront/output/snapshot.hpp"
#include "slipfront/pulse/solver.hpp"

namespace slipfront::pulse {

/// The characteristic that left the outermost change of stress at t = 0 on the more stressed side (the left one if
/// both are alike): where the trailing edge of what moves would be without any error, and without friction is.
class TrailingCharacteristic {
 public:
  /// Starts where the initial stress first departs from its value at the stressed end by 1 % of its range: at the
  /// corner of a step.
  explicit TrailingCharacteristic(const Solver& start);
  /// Follows dx/dt = lambda_- (to the left) or lambda_+ (to the right) of the state just ahead of it over one step;
  /// exact where that state is uniform and at rest.
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
  bool steady_ = false;  ///< the state ahead is uniform and stays so: its speed never changes
  double speed_ = 0;     ///< now
};

/// Everything of a snapshot. `x_edges` ascend; `threshold` is the observer's, as a share of the peak slip velocity.
output::Snapshot observe(const Solver& solver, const std::vector<double>& x_edges,
                         const TrailingCharacteristic& trailing, double threshold);

/// Energy of the interface now. An isolated dislocation has 8 a(x), which nothing changes without a contact profile, so
/// that small changes of the rest are no differences of large numbers.
struct StoredEnergy {
  double isolated;     ///< of the dislocations as if each were isolated and at rest
  double interaction;  ///< elastic energy in addition to that
  double kinetic;
  double correction;  ///< part of the sum that comes from differences between cells: its truncation error is less
  double unresolved;  ///< kinetic energy of the cells where it is not smooth, as of a pulse narrower than a cell

  double elastic() const { return isolated + interaction; }
  double all() const { return elastic() + kinetic; }
};
StoredEnergy stored_energy(const Solver& solver);

/// |dislocations counted - those there must be|, over the latter. Counted by Simpson's rule over the density that the
/// states of cells and faces mean; there must be those at t = 0 and those that came in. It is the error of the states,
/// not only rounding: 1e-6 for smooth profiles of 400 cells, more where shocks or free edges lie within few cells.
double conservation_error(const Solver& solver);

}  // namespace slipfront::pulse
