#pragma once
/// \file
/// The description of a quantity that files, tables and other languages show.

#include <string_view>

namespace slipfront {

/// Attributes that the CF conventions require of a variable. Its values are dimensionless.
struct Description {
  std::string_view name;
  std::string_view long_name;
  std::string_view dimensional_unit;  ///< multiply by this for a dimensional value; empty if there is none
  std::string_view reference;         ///< equation or section of the paper
};

}  // namespace slipfront
