#pragma once
/// \file
/// Names for the unknowns that time steps advance. Integrators see a plain vector; only this file gives its entries a
/// meaning.

#include <cstddef>
#include <limits>
#include <vector>

#include "slipfront/friction/friction.hpp"
#include "system/archive.hpp"

namespace slipfront::pulse {

/// A vector of unknowns, or of their rates: the widths of all cells, their momenta, then the totals. `Number` is double
/// or const double.
template <class Number>
class NamedValues {
 public:
  NamedValues(Number* values, std::size_t cells) : values_(values), cells_(cells) {}

  Number& width(std::size_t cell) const { return values_[cell]; }
  Number& momentum(std::size_t cell) const { return values_[cells_ + cell]; }
  Number& left_edge() const { return values_[2 * cells_]; }         ///< x of the first face
  Number& dissipated() const { return values_[2 * cells_ + 1]; }    ///< energy that friction has dissipated
  Number& supplied() const { return values_[2 * cells_ + 2]; }      ///< energy that the forcing has supplied
  Number& through_ends() const { return values_[2 * cells_ + 3]; }  ///< energy that has entered through the ends

  Number* widths() const { return values_; }
  Number* momenta() const { return values_ + cells_; }

  static constexpr std::size_t size(std::size_t cells) { return 2 * cells + 4; }

 private:
  Number* values_;
  std::size_t cells_;
};

using Values = NamedValues<double>;
using ConstValues = NamedValues<const double>;

/// Like NamedValues, but with momenta at the faces. Each face has an entry for the width of the cell to its left; the
/// entry of the first face is its x. The momenta around the faces follow, then the totals.
template <class Number>
class NamedFaceValues {
 public:
  NamedFaceValues(Number* values, std::size_t faces) : values_(values), faces_(faces) {}

  Number& left_edge() const { return values_[0]; }
  Number& width(std::size_t cell) const { return values_[cell + 1]; }
  /// The first entry of a face: the width of the cell to its left, or for the first face its x.
  Number& width_left_of(std::size_t face) const { return values_[face]; }
  Number& momentum(std::size_t face) const { return values_[faces_ + face]; }
  Number& dissipated() const { return values_[2 * faces_]; }
  Number& supplied() const { return values_[2 * faces_ + 1]; }
  Number& through_ends() const { return values_[2 * faces_ + 2]; }

  static constexpr std::size_t size(std::size_t faces) { return 2 * faces + 3; }

 private:
  Number* values_;
  std::size_t faces_;
};

using FaceValues = NamedFaceValues<double>;
using ConstFaceValues = NamedFaceValues<const double>;

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

/// A grid of x for the state variables of friction. It does not move with the cells, as dislocations pass over the
/// interface and leave its state behind; and it covers stretches without dislocations too. The values at a point follow
/// each other.
class StateGrid {
 public:
  /// `count` points between `left` and `right`.
  StateGrid(const friction::Friction& friction, double left, double right, std::size_t count);

  /// Values at t = 0; none for a law without state.
  std::vector<double> initial() const;

  /// Slip velocities of the trains that pass over points: their means, and those whose logarithms are the means over
  /// slip.
  struct Passing {
    std::vector<double> mean, typical;
  };
  /// Finds the velocities at the grid from those at x[i], which rise; 0 outside.
  void find_passing(const std::vector<double>& x, const Passing& there, Passing& here) const;
  /// Changes the values over a time in which the velocities stay the same.
  void advance(const Passing& passing, double time, std::vector<double>& values) const;
  /// Finds the state at each of `size` x between two points; that of the last point outside.
  void look_up(const std::vector<double>& values, std::size_t size, const double* x, double* state) const;

 private:
  friction::Friction friction_;
  double left_, spacing_;
  std::size_t count_, each_;  ///< points, and values at each
};

}  // namespace slipfront::pulse
