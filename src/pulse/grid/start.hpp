#pragma once

#include "pulse/grid/cells.hpp"
#include "pulse/grid/ends.hpp"
#include "slipfront/pulse/problem.hpp"

namespace slipfront::pulse {

/// The cells of a problem at t = 0, at rest.
struct Start {
  Cells cells;
  FreeEdges free;
};
/// \throws InputError if the cells have no stress that a double can hold, or a contact that jumps.
Start start_of(const Problem& problem);

}  // namespace slipfront::pulse
