#pragma once
/// \file
/// Units as people write them, "km/day" or "g cm-3".

#include <array>
#include <optional>
#include <string_view>

namespace slipfront::medium {

/// A factor to SI, and the powers of metre, kilogram and second. An angle counts as a number. The factor is not finite
/// and positive where the unit has a part beyond mechanics (K, V), an offset or a logarithm.
struct Unit {
  double factor = 1;
  std::array<int, 3> powers = {};
};

/// Names or symbols of UDUNITS-2, each with prefixes and an exponent of one digit (`km`, `s-1`, `cm^3`, `%`), joined by
/// '/', '*', '.' or one blank. Nothing for any other text.
std::optional<Unit> parse_unit(std::string_view text);

}  // namespace slipfront::medium
