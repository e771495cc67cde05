#pragma once

#include <cstddef>
#include <limits>
#include <vector>

#include "pulse/grid/values.hpp"

namespace slipfront::pulse {

/// The state of a run. Plain numbers: saved and restored, a run continues to the same bits. A gap between two stressed
/// blocks of cells is a cell without dislocations; when its edges meet, it goes.
struct Cells {
  double time = 0;
  long steps = 0;
  double step = 0;               ///< longest that the error of the last step allows, 0 before the first
  std::vector<double> unknowns;  ///< what time steps advance, with the names below
  std::vector<double> s;         ///< tanh(psi) at the cell centres, where the next solve starts
  std::vector<double> charge;    ///< dislocations in each cell, constant; 0 in a gap
  double entered_left = 0;       ///< dislocations that have come in (less those that have left) through the left end
  double entered_right = 0;      ///< and through the right one
  double crossing_time = std::numeric_limits<double>::quiet_NaN();      ///< of the first crossing; NaN: none so far
  double crossing_position = std::numeric_limits<double>::quiet_NaN();  ///< and its x
  std::vector<double> face_momentum;  ///< where friction rules: momenta live at the faces, cells have means; else empty

  std::vector<double> state;  ///< state of friction on a grid that does not move with the cells; empty: none

  std::size_t size() const { return charge.size(); }
  Values values() { return {unknowns.data(), size()}; }
  ConstValues values() const { return {unknowns.data(), size()}; }
  double& width(std::size_t cell) { return values().width(cell); }
  double width(std::size_t cell) const { return values().width(cell); }
  double& momentum(std::size_t cell) { return values().momentum(cell); }
  double momentum(std::size_t cell) const { return values().momentum(cell); }
  double& left_edge() { return values().left_edge(); }  ///< x
  double left_edge() const { return values().left_edge(); }

  /// x of the face to the left of a cell; of the last face for size().
  double left_face(std::size_t cell) const;
  /// x in the middle of a cell.
  double centre(std::size_t cell) const { return left_face(cell) + width(cell) / 2; }
  /// Writes x in the middle of each cell to `x`, which has size() elements.
  void find_centres(std::vector<double>& x) const;
  /// A cell that is put before the cell of this index.
  struct Cell {
    double charge, width, momentum, s;
  };
  Cell cell(std::size_t i) const { return {charge[i], width(i), momentum(i), s[i]}; }
  void insert(std::size_t before, const Cell& cell);
  void erase(std::size_t i);
  /// Puts the contents of a cell into a neighbour of it.
  void join(std::size_t i, std::size_t into);
};

}  // namespace slipfront::pulse
