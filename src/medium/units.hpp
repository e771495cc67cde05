#pragma once
/// \file
/// Reads units as people write them, such as "km/day" or "g cm-3".

#include <array>
#include <optional>
#include <string_view>

namespace slipfront::medium {

/// The factor to SI units, and the exponents of metre, kilogram and second. An angle counts as a number. Units with a
/// part outside mechanics (K, V), an offset or a logarithm have a factor that is not finite and positive.
struct Unit {
  double factor = 1;
  std::array<int, 3> powers = {};
};

/// Parses names or symbols of UDUNITS-2, joined by '/', '*', '.' or one blank. Each may have prefixes and an exponent
/// of one digit (`km`, `s-1`, `cm^3`, `%`). Returns nothing for any other text.
std::optional<Unit> parse_unit(std::string_view text);

}  // namespace slipfront::medium
