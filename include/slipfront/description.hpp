#pragma once
/// \file
/// What is said of a quantity wherever it goes: files, tables, other languages.

#include <string_view>

namespace slipfront {

/// What CF asks to be said of a variable; values are dimensionless.
struct Description {
  std::string_view name;
  std::string_view long_name;
  std::string_view dimensional_unit;  ///< multiply by this for a dimensional value; empty: none
  std::string_view reference;         ///< where in the paper
};

}  // namespace slipfront
