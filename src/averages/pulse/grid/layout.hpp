#pragma once

#include <functional>
#include <vector>

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

/// The cells at t = 0: where each dislocation began.
struct InitialGrid {
  InitialGrid(const Problem& problem, const Cells& at_start, FreeEdges free);

  std::vector<double> faces;    ///< x
  std::vector<double> charges;  ///< dislocations to the left of each face
  FreeEdges free;
  std::function<double(double)> stress;
  bool contact_varies = false;

  /// x at t = 0 of the dislocation at a face that has `charge` dislocations to its left.
  double position_of(double charge) const;
  /// Dislocations between two positions at t = 0: the integral of the initial stress over 2 pi.
  double charge_between(double from, double to) const;
  /// Whether saved cells may have come from these. Cells may have been joined, gaps may have closed and dislocations
  /// may have come in since t = 0; the faces that are left have as many dislocations to their left as they had.
  bool fits(const Cells& cells, std::size_t state_values) const;
};

/// Integrates f from a to b by the ten-point Gauss rule, which is exact to rounding for smooth stress in one cell.
double integral(const std::function<double(double)>& f, double a, double b);

/// The cells at t = 0. The cell of a gap holds no dislocations.
struct Layout {
  std::vector<double> faces;   ///< x of the faces, one more than cells
  std::vector<double> charge;  ///< dislocations in each cell, the integral of stress / 2 pi
  bool left_free, right_free;  ///< whether the stress ends inside the domain, in a free edge
};

/// Ends of the domain that are free edges even if the stress reaches them.
struct FreeEnds {
  bool left = false, right = false;
};
/// Creates the cells at t = 0 in the stretches of [left, right] that have stress. They share `cells` cells in
/// proportion to their lengths, but each gets at least 4. Each gap between two stretches is one more cell. Cells are
/// finer where the stress changes, and graded quadratically towards free edges, where a fan opens from a point. If
/// `corner`, the x of a step of stress, is inside a stretch, it becomes a face. \throws InputError if there is no
/// stress, or if a stretch is too narrow to sample.
Layout lay_cells(const std::function<double(double)>& stress, double left, double right, int cells, double corner,
                 FreeEnds free = {});

/// The cells of a problem at t = 0, at rest.
struct Start {
  Cells cells;
  FreeEdges free;
};
/// \throws InputError if the cells have no stress that a double can hold, or a contact that jumps.
Start start_of(const Problem& problem);

}  // namespace slipfront::pulse
