#pragma once
/// \file
/// What is measured of a run at one time: profiles on a fixed grid, fronts, energies.

#include <vector>

#include "slipfront/pulse/snapshot.hpp"
#include "slipfront/pulse/solver.hpp"

namespace slipfront::pulse {

/// The characteristic that left the leftmost change of stress at t = 0: the trailing (or left) edge of what moves.
class LeftFront {
 public:
  /// Starts where the initial stress first departs from its value at the left end by 1 % of its range: at the corner of
  /// a step.
  explicit LeftFront(const Solver& start);
  /// Follows dx/dt = lambda_- of the state just ahead of it over one step; exact where that state is uniform and at
  /// rest.
  void advance(const Solver& now, double dt);
  double position() const { return position_; }
  void restore(double position) { position_ = position; }

 private:
  double position_;
  bool steady_ = false;  ///< the state ahead is uniform and stays so: its speed never changes
  double speed_ = 0;
};

/// Everything of Snapshot. `x_edges` ascend; `left_front` is where LeftFront stands; `threshold` is the observer's, as
/// a share of the peak slip velocity.
Snapshot observe(const Solver& solver, const std::vector<double>& x_edges, double left_front, double threshold);

/// |dislocations in the cells of the grid and outside it - those at t = 0|, over those at t = 0.
double conservation_error(const Solver& solver, const std::vector<double>& x_edges, const Profile& profile);

}  // namespace slipfront::pulse
