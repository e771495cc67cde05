#pragma once

#include <functional>
#include <vector>

namespace slipfront::pulse {

/// Cells at t = 0: faces in x and the dislocations between them.
struct Layout {
  std::vector<double> faces;   ///< x, cells + 1
  std::vector<double> charge;  ///< dislocations in each cell, the integral of stress / 2 pi
  bool left_free, right_free;  ///< the stress ends inside the domain: a free edge
};

/// Cells over the stretch of [left, right] that carries stress. Even in x, but quadratically graded towards free edges
/// (where a fan opens from a point); `corner` inside the stretch becomes a face (a step of stress). \throws InputError
/// for no stress at all, or for an empty gap between stressed stretches.
Layout lay_cells(const std::function<double(double)>& stress, double left, double right, int cells, double corner);

}  // namespace slipfront::pulse
