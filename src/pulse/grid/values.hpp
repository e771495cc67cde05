#pragma once
/// \file
/// Names for the unknowns that time steps advance. Integrators see a plain vector; only this file gives its entries a
/// meaning.

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

}  // namespace slipfront::pulse
