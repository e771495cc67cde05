#pragma once
/// \file
/// The names and symbols of the units of UDUNITS-2.

#include <span>
#include <string_view>

#include "text/units.hpp"

namespace slipfront::medium {

struct NamedUnit {
  std::string_view name;
  Unit unit;
};

/// Both tables are sorted. Names do not distinguish capital and small letters, and are stored in small letters. Symbols
/// do distinguish them.
extern const std::span<const NamedUnit> unit_names, unit_symbols;

}  // namespace slipfront::medium
