#pragma once
/// \file
/// The unknowns of the averaged solver: the distances of closed dislocation lines ("loops") from the origin. The label
/// q counts loops from the outside inwards, in units of a scenario: one loop is a step of 2 pi of the slip. Rows of the
/// arrays are labels, columns are angles.

#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

#include "slipfront/lattice/plane/problem.hpp"

namespace slipfront::plane {

struct Loops {
  std::size_t rows = 0;       ///< number of cells along the label
  std::size_t angles = 1;     ///< number of angles; 1: all angles are equal
  std::vector<double> label;  ///< q of the rows + 1 faces, ascending from 0 at the outermost loop
  std::vector<double> wall;   ///< distance of the held region from the origin for each angle; 0: none

  double time = 0;
  long steps = 0;
  std::vector<double> r;         ///< distances of the faces, (rows + 1) x angles
  std::vector<double> momentum;  ///< Pi = r M of the cells, rows x angles; M is the momentum of a loop per length
  std::vector<double> s;         ///< tanh(psi) of the cells, the initial guess of the next solution
  double limit = 0;              ///< longest stable step at `time`; 0: not known yet
  double power = 0, supply = 0;  ///< power of friction and of the force F at `time`
  std::vector<double> loss;      ///< rate at which friction takes Pi in each cell
  double dissipated = 0, supplied = 0;
  double vanished = 0;        ///< energy of loops that have shrunk to a point
  double vanished_since = 0;  ///< time at which the first of them did, if `vanished` is not 0

  double charge(std::size_t row) const { return label[row + 1] - label[row]; }
  double turn() const { return 2 * std::numbers::pi / static_cast<double>(angles); }
  double angle(std::size_t k) const { return turn() * static_cast<double>(k); }
  std::size_t cells() const { return rows * angles; }

  /// Whether the innermost loop has nearly shrunk to the origin in some direction.
  bool innermost_vanishes() const;
  /// Removes the innermost cells of all directions.
  void remove_innermost();
};

/// The loops of the initial slip. \throws InputError if its contours are not star-shaped closed lines around the
/// origin.
Loops initial_loops(const Problem& problem, std::size_t rows, std::size_t angles);

}  // namespace slipfront::plane
