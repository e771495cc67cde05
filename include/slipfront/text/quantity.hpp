#pragma once
/// \file
/// Quantities as people write them: "3.0 km/s", "10 km/day", "30 GPa", "2-15 km/day".

#include <optional>
#include <string>
#include <string_view>

namespace slipfront::medium {

/// The dimension of a quantity. The first of its units is the SI unit.
enum class Dimension { velocity, length, area, time, pressure, density, moment, stiffness, spring, ratio };

/// Text for the `allowed` part of an error, such as "a velocity, such as 3.0 km/s or 10 km/day".
std::string_view example(Dimension dimension);

/// The SI unit in symbols, such as "m/s"; empty for a ratio.
std::string_view si_unit(Dimension dimension);

/// A number or a closed range of numbers, in SI units.
struct Span {
  double low;
  double high;
};

/// The finite number that the whole text is, in any locale. Nothing if the text is no finite number, such as 1e400.
std::optional<double> number(std::string_view text);

/// Whether the text is a unit, such as "km/day".
bool is_unit(std::string_view text);

/// Factor that converts from `unit` to the SI unit of `dimension`. \throws InputError (problem and allowed only) for an
/// unknown unit or one of another dimension.
double unit_factor(std::string_view unit, Dimension dimension);

/// Like unit_factor, for the unit of a column, which may begin with a number: "1e19 N m".
double column_unit_factor(std::string_view unit, Dimension dimension);

/// Reads "3.0 km/s" as 3000 m/s, and a range such as "2-15 km/day" with both ends. A number without a unit has
/// `default_unit`, the unit of a column. If that is empty, the number is an error, except for a ratio. \throws
/// InputError (value, problem and allowed only).
Span parse_quantity(std::string_view text, Dimension dimension, std::string_view default_unit = {});

}  // namespace slipfront::medium
