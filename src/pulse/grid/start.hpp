#pragma once

#include "pulse/grid/cells.hpp"
#include "pulse/grid/ends.hpp"
#include "slipfront/pulse/problem.hpp"

namespace slipfront::pulse {

/// \throws InputError for settings that no run can have.
void check(const Problem& problem);

/// The cells of a problem at t = 0, at rest.
struct Start {
  Cells cells;
  FreeEdges free;
};
Start start_of(const Problem& problem);

}  // namespace slipfront::pulse
