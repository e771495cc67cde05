#pragma once

#include <functional>
#include <vector>

namespace slipfront::pulse {

/// By the ten-point Gauss rule: exact to rounding for smooth stress in one cell.
double integral(const std::function<double(double)>& f, double a, double b);

/// Cells at t = 0: faces in x and the dislocations between them, none in the cell of a gap.
struct Layout {
  std::vector<double> faces;   ///< x, cells + 1
  std::vector<double> charge;  ///< dislocations in each cell, the integral of stress / 2 pi
  bool left_free, right_free;  ///< the stress ends inside the domain: a free edge
};

/// Cells over the stretches of [left, right] that carry stress, `cells` of them shared out by length (but 4 at least
/// each), and one for each gap between two. Finer where the stress changes and quadratically graded towards free edges
/// (where a fan opens from a point); `corner` inside a stretch becomes a face (a step of stress). \throws InputError
/// for no stress at all.
struct FreeEnds {
  bool left = false, right = false;  ///< of the domain
};
Layout lay_cells(const std::function<double(double)>& stress, double left, double right, int cells, double corner,
                 FreeEnds free = {});

}  // namespace slipfront::pulse
