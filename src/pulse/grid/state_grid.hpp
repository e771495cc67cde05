#pragma once

#include <cstddef>
#include <vector>

#include "slipfront/friction/friction.hpp"

namespace slipfront::pulse {

/// A grid of x for the state variables of friction. It does not move with the cells, as dislocations pass over the
/// interface and leave its state behind; and it covers stretches without dislocations too. The values at a point follow
/// each other.
class StateGrid {
 public:
  /// `count` points between `left` and `right`.
  StateGrid(const friction::Friction& friction, double left, double right, std::size_t count);

  /// Values at t = 0; none for a law without state.
  std::vector<double> initial() const;

  /// Slip velocities of the trains that pass over points: their means, and those whose logarithms are the means over
  /// slip.
  struct Passing {
    std::vector<double> mean, typical;
  };
  /// Finds the velocities at the grid from those at x[i], which rise; 0 outside.
  void find_passing(const std::vector<double>& x, const Passing& there, Passing& here) const;
  /// Changes the values over a time in which the velocities stay the same.
  void advance(const Passing& passing, double time, std::vector<double>& values) const;
  /// Finds the state at each of `size` x between two points; that of the last point outside.
  void look_up(const std::vector<double>& values, std::size_t size, const double* x, double* state) const;

 private:
  friction::Friction friction_;
  double left_, spacing_;
  std::size_t count_, each_;  ///< points, and values at each
};

}  // namespace slipfront::pulse
