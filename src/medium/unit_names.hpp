#pragma once
/// \file
/// The names of units, as UDUNITS-2 has them.

#include <span>
#include <string_view>

#include "medium/units.hpp"

namespace slipfront::medium {

struct NamedUnit {
  std::string_view name;
  Unit unit;
};

/// Sorted by name. Capital letters are like small ones in names, which are kept small, and differ in symbols.
extern const std::span<const NamedUnit> unit_names, unit_symbols;

}  // namespace slipfront::medium
