#pragma once
/// \file
/// Converts results to SI units. Each result has a unit of the model, such as "mu A / pi", in the symbols of the
/// medium.

#include <string>
#include <string_view>

#include "slipfront/theory/medium/constants.hpp"

namespace slipfront::medium {

/// Values of the symbols, in SI units. A value that is not known is NaN.
struct SymbolValues {
  double mu;  ///< shear modulus, Pa
  double nu;  ///< Poisson's ratio
  double A;   ///< contact ratio
  double b;   ///< asperity spacing, m
  double c;   ///< speed of strain waves, m/s
};

/// A unit of the model in SI units.
struct UnitInSi {
  double value = 1;
  std::string name = "1";      ///< as UDUNITS reads it, such as "m s-1"
  bool between_faces = false;  ///< for slip: `value` is twice the unit, which is that of one face (face_factor)
};

/// The value of a unit. It is a product of numbers, symbols, pi and their powers, such as "mu A^2 / (pi (1 - nu))".
/// The slip of one face, in b / (2 pi), becomes the slip between the faces; its integral along a line or over a plane
/// does too. \throws InputError for another text.
UnitInSi in_si(std::string_view unit, const SymbolValues& values);

/// The symbols that a unit has, without pi, with blanks between them. \throws InputError like in_si.
std::string symbols_of(std::string_view unit);

/// The units of results in SI units, for one medium.
class SiUnits {
 public:
  /// \throws InputError (problem and allowed only) if `medium` lacks the contact ratio or the asperity spacing. Other
  /// constants have defaults (Defaults).
  explicit SiUnits(const Constants& medium);

  /// The value and the name of a unit of the model. The empty text is a pure number.
  UnitInSi of(std::string_view unit) const { return unit.empty() ? UnitInSi{} : in_si(unit, values_); }
  /// The constants, such as "A = 0.01, b = 0.001 m, ...".
  std::string in_words() const;
  /// The constants that were assumed, in words; empty if the medium has all.
  const std::string& assumed() const { return assumed_; }

 private:
  SymbolValues values_;
  std::string assumed_;
};

}  // namespace slipfront::medium
