#pragma once

#include <functional>
#include <vector>

#include "pulse/grid/cells.hpp"
#include "pulse/grid/ends.hpp"
#include "slipfront/pulse/problem.hpp"

namespace slipfront::pulse {

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

}  // namespace slipfront::pulse
