#pragma once
/// \file
/// Measurements of a run at one time: profiles on a fixed grid, fronts, energies.

#include <vector>

#include "pulse/observe/trailing_characteristic.hpp"
#include "pulse/solver.hpp"
#include "slipfront/output/snapshot.hpp"

namespace slipfront::pulse {

/// Everything of a snapshot. `x_edges` ascend; `threshold` is the observer's, as a share of the peak slip velocity.
output::Snapshot observe(const Solver& solver, const std::vector<double>& x_edges,
                         const TrailingCharacteristic& trailing, double threshold);

}  // namespace slipfront::pulse
