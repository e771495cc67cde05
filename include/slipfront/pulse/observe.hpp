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
  void restore(double position) { position_ = position; }

 private:
  double speed_into(const State& ahead) const;

  double position_;
  bool stressed_left_;
  bool steady_ = false;  ///< the state ahead is uniform and stays so: its speed never changes
  double speed_ = 0;
};

/// Everything of a snapshot. `x_edges` ascend; `threshold` is the observer's, as a share of the peak slip velocity.
output::Snapshot observe(const Solver& solver, const std::vector<double>& x_edges,
                         const TrailingCharacteristic& trailing, double threshold);

/// Of the interface now; `shocks` is left open (NaN), as it needs the energy at t = 0.
output::Energy energy_of(const Solver& solver);

/// |dislocations counted - those there must be|, over the latter. Counted by Simpson's rule over the density that the
/// states of cells and faces mean; there must be those at t = 0 and those that came in. It is the error of the states,
/// not only rounding: 1e-6 for smooth profiles of 400 cells, more where shocks or free edges lie within few cells.
double conservation_error(const Solver& solver);

}  // namespace slipfront::pulse
