#pragma once
/// \file
/// Quantities as people write them: "3.0 km/s", "10 km/day", "30 GPa", "2-15 km/day".

#include <optional>
#include <string>
#include <string_view>

namespace slipfront::medium {

/// What a quantity may be. The first of its units is the SI one.
enum class Dimension { velocity, length, time, pressure, density, ratio };

/// "a velocity, such as 3.0 km/s or 10 km/day": for the `allowed` part of an error.
std::string_view example(Dimension dimension);

/// A number or a closed range of numbers, in SI units.
struct Span {
  double low;
  double high;
};

/// A finite number, the whole text and nothing else, independent of the locale; nothing if it is none (1e400 is none).
std::optional<double> number(std::string_view text);

/// Factor from `unit` to the SI unit of `dimension`. \throws InputError (problem and allowed only) for an unknown unit
/// or one of another dimension.
double unit_factor(std::string_view unit, Dimension dimension);

/// "3.0 km/s" -> 3000; a range "2-15 km/day" keeps both ends. A number alone takes `default_unit`, and is an error
/// where that is empty (except for a ratio). \throws InputError (value, problem and allowed only).
Span parse_quantity(std::string_view text, Dimension dimension, std::string_view default_unit = {});

}  // namespace slipfront::medium
