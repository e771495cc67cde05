#pragma once
/// \file
/// The rupture front on a grid: the contour U = 0. Outside it the slip continues with negative values, so that the
/// front moves as its lines do.

#include <vector>

#include "averages/grid/equations.hpp"

namespace slipfront::plane {

/// Gradient of the slip just outside the front, in the frame of the lines. The pressure of such lines is 0.004, and so
/// nearly that of the outermost one, which is 0. A smaller value makes the front too fast on coarse grids.
inline constexpr double gradient_ahead = 0.7;

class Front {
 public:
  Front(const Problem& problem, const Cells& cells);
  /// Continues slip and action over the front by some cells, and sets both to 0 farther out. Returns the cells in which
  /// they are known.
  const std::vector<char>& extend(Averages& now);

 private:
  struct Neighbours;
  Neighbours neighbours_of(std::size_t cell, const Averages& now) const;
  void set_first(std::size_t cell, const Neighbours& n, Averages& now) const;

  const Problem& problem_;
  const Cells& cells_;
  double psi_ahead_, J0_ahead_;
  std::vector<char> known_;
  std::vector<std::size_t> empty_, found_;
};

}  // namespace slipfront::plane
