#pragma once

#include <cstddef>
#include <vector>

#include "pulse/friction/friction_solve.hpp"
#include "pulse/grid/cells.hpp"
#include "pulse/grid/state_grid.hpp"
#include "pulse/space/cell_states.hpp"
#include "slipfront/pulse/problem.hpp"

namespace slipfront::pulse {

/// Computes friction on the cells over one step, with the state variables in the middle of the step. The arrays are
/// reused from step to step.
class CellFriction {
 public:
  CellFriction(const Problem& problem, std::size_t cells);
  /// Prepares a step from these cells, whose trains have the states `trains`. Cells outside `awake` are at rest
  /// throughout the step.
  void start(const Cells& cells, const CellStates& trains, CellRange awake, const StateGrid& grid);

  const std::vector<double>& x() const { return x_; }  ///< centres
  /// Finds the slip velocities at the centres of `cells` from the velocities of the last call.
  void find_passing(const Cells& cells, StateGrid::Passing& passing) const;
  /// Looks up the state variables where the cell centres are in the middle of a step of length `dt`.
  void take_state(const StateGrid& grid, const std::vector<double>& values, double dt);
  /// Has the signature of Ars443::Friction.
  void operator()(const double* y, const double* free, double time, double* momentum, double* velocity);
  /// Mean friction forces from the last call.
  const std::vector<double>& forces() const { return force_; }
  /// Length of a step in friction times, for each cell, by the last call: its length times the slope of friction.
  const std::vector<double>& friction_times(double time);
  /// Error of a step of length `time` that used the forces `forces_before`, if the state variables last looked up are
  /// right. It is the root mean square over a sample of the cells, in units of `scale`.
  double state_error(const std::vector<double>& forces_before, double time, const std::vector<double>& scale);
  /// Returns to the start of the step, for another attempt.
  void restart();

 private:
  std::size_t variables() const { return problem_.friction.state_size(); }
  double contact(std::size_t cell) const { return problem_.contact ? problem_.contact(x_[cell]) : 1; }
  void find_forces(const std::vector<double>& s, std::size_t stride = 1);

  const Problem& problem_;
  SlowedTrains solve_;
  CellRange awake_{0, 0};
  std::vector<double> charge_, x_, contact_, state_;
  // Values per dislocation, at the start of the step and from the last call.
  std::vector<double> start_, start_s_, start_typical_, start_momentum_, start_force_, start_slope_;
  std::vector<double> s_, momentum_, velocity_, typical_, force_, slope_;
  std::vector<double> strength_at_rest_, held_;  ///< friction strength at rest, as a force and as a momentum
  std::vector<double> free_, guess_, moves_, spacing_, middle_;
  std::vector<double> fastest_;  ///< largest slip velocity in each cell
  std::vector<double> friction_times_;
  std::vector<std::size_t> slipping_;
  std::vector<double> slipping_fastest_, slipping_s_, slipping_state_, slipping_force_, slipping_slope_;
};

}  // namespace slipfront::pulse
