#pragma once

#include <cstddef>
#include <limits>
#include <vector>

#include "foundation/archive.hpp"
#include "pulse/grid/values.hpp"

namespace slipfront::pulse {

/// The state of a run, in plain numbers: a run that is saved and restored gives bitwise identical results. A gap
/// between two stressed blocks of cells is one cell without dislocations. It is removed when its edges meet.
struct Cells {
  double time = 0;
  long steps = 0;
  double step = 0;               ///< longest step that the error of the last step allows; 0 before the first step
  std::vector<double> unknowns;  ///< the unknowns that time steps advance, with the names below
  std::vector<double> s;         ///< tanh(psi) at the cell centres, the initial guess of the next solve
  std::vector<double> charge;    ///< dislocations in each cell, constant; 0 in a gap
  double entered_left = 0;       ///< dislocations that have entered, less those that have left, through the left end
  double entered_right = 0;      ///< dislocations that have entered, less those that have left, through the right end
  double crossing_time = std::numeric_limits<double>::quiet_NaN();  ///< time at which streams first crossed; NaN: never
  double crossing_position = std::numeric_limits<double>::quiet_NaN();  ///< x of that crossing
  std::vector<double> face_momentum;  ///< momenta at the faces if friction dominates (cells hold means), else empty

  std::vector<double> state;  ///< state variables of friction on a grid that does not move with the cells; empty: none

  void archive(Archive& a) {
    a(time, steps, step, unknowns, s, charge, entered_left, entered_right, crossing_time, crossing_position,
      face_momentum, state);
    a.require(steps >= 0);
  }

  std::size_t size() const { return charge.size(); }
  Values values() { return {unknowns.data(), size()}; }
  ConstValues values() const { return {unknowns.data(), size()}; }
  double& width(std::size_t cell) { return values().width(cell); }
  double width(std::size_t cell) const { return values().width(cell); }
  double& momentum(std::size_t cell) { return values().momentum(cell); }
  double momentum(std::size_t cell) const { return values().momentum(cell); }
  double& left_edge() { return values().left_edge(); }  ///< x
  double left_edge() const { return values().left_edge(); }

  /// x of the left face of a cell. For size(), x of the last face.
  double left_face(std::size_t cell) const;
  /// x in the middle of a cell.
  double centre(std::size_t cell) const { return left_face(cell) + width(cell) / 2; }
  /// Writes x in the middle of each cell to `x`, which has size() elements.
  void find_centres(std::vector<double>& x) const;
  /// The values of one cell.
  struct Cell {
    double charge, width, momentum, s;
  };
  Cell cell(std::size_t i) const { return {charge[i], width(i), momentum(i), s[i]}; }
  /// Inserts `cell` in front of the cell with index `before`.
  void insert(std::size_t before, const Cell& cell);
  void erase(std::size_t i);
  /// Adds the contents of cell i to its neighbour `into`, and removes cell i.
  void join(std::size_t i, std::size_t into);
};

}  // namespace slipfront::pulse
