#pragma once

#include <vector>

#include "slipfront/error.hpp"

namespace slipfront::pulse {

/// A step is shortened at most so often.
constexpr int most_shortenings = 80;

/// Error of a run in which no step is short enough for the forces.
NumericsError too_strong_forces(double time);

/// Whether a step has changed the rapidity of some cell by about a half or more, or has compressed a cell to a tenth: a
/// dense train that runs into a sparse one, or a contact as steep as a wall. The error of the step does not show this,
/// as it leaves out the cells near a shock.
bool cells_jump(const std::vector<double>& before, const std::vector<double>& after, const std::vector<double>& charge);

}  // namespace slipfront::pulse
