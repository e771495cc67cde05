#pragma once

#include "averages/pulse/grid/cells.hpp"
#include "slipfront/averages/pulse/problem.hpp"

namespace slipfront::pulse {

/// Time until the edges of a gap meet, or a train that has left a wall is back at it, from the rates of the unknowns.
double gaps_close_in(const Problem& problem, const Cells& cells, const double* rates);

/// Joins the cells on both sides of each gap whose edges have met. Returns whether there was one.
bool close_gaps(Cells& cells);

/// Whether the stress ends inside the domain, on either side.
struct FreeEdges {
  bool left, right;
};

/// Lets dislocations come in or leave through the ends of the domain after a step, or stops them at a wall. Returns
/// whether there are other cells now. \throws NumericsError if a train has left an end by thousands of cells.
bool adjust_ends(const Problem& problem, FreeEdges free, Cells& cells);

}  // namespace slipfront::pulse
