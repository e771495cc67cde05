#pragma once

#include <functional>
#include <vector>

#include "pulse/grid/cells.hpp"
#include "pulse/grid/ends.hpp"
#include "pulse/space/block.hpp"
#include "slipfront/friction/friction.hpp"
#include "slipfront/pulse/problem.hpp"

namespace slipfront::pulse {

/// The parts of a problem on which the equations in space depend.
struct Setup {
  std::vector<double> charge;  ///< dislocations in each cell, 0 in a gap
  Edge left = Edge::continued, right = Edge::continued;
  double left_wall = 0, right_wall = 0;  ///< x, where the edges are walls
  friction::Friction friction;
  std::function<double(double, double)> forcing;  ///< null: none
  std::function<double(double)> contact;          ///< a(x); null: 1
  bool friction_apart = false;                    ///< the rates of Semidiscrete are those without friction
};
Setup setup_of(const Problem& problem, const Cells& cells, FreeEdges free);

/// Whether friction damps slow trains at any rate, but does not hold them, as powers of the velocity below 1 do.
bool is_steep(const friction::Friction& friction);
/// Whether steps take friction cell by cell: where it has state variables, or is steep at rest.
bool takes_friction_by_cells(const Problem& problem);

}  // namespace slipfront::pulse
