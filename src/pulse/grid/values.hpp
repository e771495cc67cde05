#pragma once
/// \file
/// Names for the numbers that time steps advance. A step sees a vector; only this file knows what its entries mean.

#include <cstddef>

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
  Number& dissipated() const { return values_[2 * cells_ + 1]; }    ///< energy that friction has taken
  Number& supplied() const { return values_[2 * cells_ + 2]; }      ///< energy that the forcing has given
  Number& through_ends() const { return values_[2 * cells_ + 3]; }  ///< energy that came in through the ends

  Number* widths() const { return values_; }
  Number* momenta() const { return values_ + cells_; }

  static constexpr std::size_t size(std::size_t cells) { return 2 * cells + 4; }

 private:
  Number* values_;
  std::size_t cells_;
};

using Values = NamedValues<double>;
using ConstValues = NamedValues<const double>;

/// The same where momenta live at the faces: of each face the width of the cell to its left (of the first face: its x),
/// of each face the momentum around it, then the totals.
template <class Number>
class NamedFaceValues {
 public:
  NamedFaceValues(Number* values, std::size_t faces) : values_(values), faces_(faces) {}

  Number& left_edge() const { return values_[0]; }
  Number& width(std::size_t cell) const { return values_[cell + 1]; }
  /// The entry of a face beside its momentum: its x of the first face, the width of the cell to its left of others.
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

}  // namespace slipfront::pulse
