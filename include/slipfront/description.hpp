#pragma once
/// \file
/// The description of a number or of a variable. It is written once, next to the code that computes the values. Text,
/// JSON, NetCDF, SI units, errors, Python, plots and the explorer read it.

#include <string_view>
#include <vector>

namespace slipfront {

/// How the error of a number of a pulse is found from runs with fewer cells (run/errors).
enum class ErrorRule {
  unknown,         ///< it is an input, or describes the computation
  change,          ///< from the changes as the cells are doubled
  stress,          ///< stress at x = 0; `--tolerance` applies to this rule and the next three
  slip,            ///< slip at x = 0, which is computed in two ways
  slip_velocity,   ///< slip velocity at x = 0
  peak,            ///< not below that at x = 0
  peak_position,   ///< it covers positions that slip as fast within the error of the peak
  position,        ///< a position that is read from a few cells
  characteristic,  ///< a position that is followed exactly
  front,           ///< a front that several cells have to show
  observed_front   ///< a front that an observer with a threshold sees
};

/// Attributes that the CF conventions require of a variable, and what else describes it. Its values are dimensionless.
struct Description {
  std::string_view name;
  std::string_view long_name;
  std::string_view dimensional_unit;  ///< multiply by this for a dimensional value; empty if there is none
  std::string_view reference;         ///< equation or section of the paper
  std::string_view reason = {};       ///< why a value may be absent (NaN); empty if it never is
  ErrorRule error = ErrorRule::unknown;
  std::string_view si_unit = {};  ///< unit of a number that has one; empty if it is dimensionless
};

/// An array that is a member of a struct.
template <class Owner>
struct MemberArray {
  Description about;
  std::vector<double> Owner::*values;
};

}  // namespace slipfront
