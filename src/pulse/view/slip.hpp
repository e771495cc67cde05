#pragma once

#include "pulse/grid/initial_grid.hpp"
#include "pulse/view/view.hpp"

namespace slipfront::pulse {

/// Slip at x since t = 0: 2 pi times the dislocations that have passed it, the integral of the initial stress from
/// where the dislocation now at x began. This is no difference of sums, so that a small slip has small errors.
double slip_at(const InitialGrid& initial, const Cells& cells, const View& view, double x);

}  // namespace slipfront::pulse
