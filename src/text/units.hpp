#pragma once
/// \file
/// Reads units as people write them, such as "km/day" or "g cm-3".

#include <array>
#include <optional>
#include <string>
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

/// The text of a number or unit in plain characters: typographic blanks become blanks, a minus sign becomes '-', an en
/// dash between two numbers "..", "x 10^18" becomes "e18", and superscripts, a raised dot and the micro sign become
/// what units are written with ("m s-1", "um"). Other characters are not changed.
std::string plain_number(std::string_view text);

/// A unit as published, in the spelling of UDUNITS: `(km/s)`, `Days`, `KM/S`, `Nm`, `dyn-cm`, `m·s⁻¹`, `km.s-1`.
/// Returns the text itself if no change makes it a known unit.
std::string plain_unit(std::string_view text);

/// The unit of a column, which may begin with a number: "x 10^18 Nm" is "1e18 N m". Otherwise like plain_unit.
std::string plain_column_unit(std::string_view text);

/// The unit of a text that is one number and a unit, in the spelling of UDUNITS. Nothing for other texts.
std::optional<std::string> unit_of(std::string_view text);

}  // namespace slipfront::medium
