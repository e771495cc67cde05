#pragma once

#include <functional>
#include <vector>

namespace slipfront::pulse {

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

}  // namespace slipfront::pulse
