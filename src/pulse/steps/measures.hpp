#pragma once

#include <vector>

#include "pulse/grid/cells.hpp"
#include "pulse/grid/initial_grid.hpp"
#include "pulse/space/semidiscrete.hpp"
#include "slipfront/pulse/problem.hpp"

namespace slipfront::pulse {

/// No momentum is measured by less: a scale of 0 would make the error of a cell at rest no number.
constexpr double smallest_scale = 1e-305;

/// The sizes by which the errors of time steps are measured.
class Measures {
 public:
  Measures(const Problem& problem, const InitialGrid& initial) : problem_(problem), initial_(initial) {}

  /// Scales of widths and momenta, in the order of the unknowns, from the last rates of `equations`.
  void find_scale(const Cells& cells, const Semidiscrete& equations, double crossing, std::vector<double>& scale) const;
  /// Largest mean velocity of some dislocations since t = 0.
  double mean_speed(const Cells& cells) const;
  /// Momentum that a step misses where the load F(x, t) jumps after the last stage of the step, as a fraction of the
  /// largest momentum that the load supplies or that there is. 64 cells are sampled, because F is costly to evaluate.
  double unseen_push(const Cells& cells, double dt) const;

 private:
  const Problem& problem_;
  const InitialGrid& initial_;
};

}  // namespace slipfront::pulse
