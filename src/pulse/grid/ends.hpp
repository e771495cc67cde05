#pragma once

#include "pulse/grid/cells.hpp"
#include "slipfront/pulse/problem.hpp"

namespace slipfront::pulse {

/// Whether the stress ends inside the domain, on either side.
struct FreeEdges {
  bool left, right;
};

/// Lets dislocations come in or leave through the ends of the domain after a step, or stops them at a wall. Returns
/// whether there are other cells now. \throws NumericsError if a train has left an end by thousands of cells.
bool adjust_ends(const Problem& problem, FreeEdges free, Cells& cells);

}  // namespace slipfront::pulse
