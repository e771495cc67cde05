#include "slipfront/medium/quantity.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <string>
#include <utility>

#include "foundation/text/trimmed.hpp"
#include "medium/plain_text.hpp"
#include "medium/units.hpp"
#include "slipfront/error.hpp"

namespace slipfront::medium {
namespace {

struct Kind {
  std::array<int, 3> powers;  // exponents of metre, kilogram and second
  const char* name;
  const char* example;
  const char* si = "";
};

const Kind& kind(Dimension dimension) {
  static constexpr Kind velocity{{1, 0, -1}, "a velocity", "a velocity, such as 3.0 km/s or 10 km/day", "m/s"};
  static constexpr Kind length{{1, 0, 0}, "a length", "a length, such as 4 mm or 1.2 m", "m"};
  static constexpr Kind area{{2, 0, 0}, "an area", "an area, such as 300 km2", "m2"};
  static constexpr Kind moment{{2, 1, -2}, "a seismic moment", "a seismic moment, such as 1e18 N m", "N m"};
  static constexpr Kind time{{0, 0, 1}, "a time", "a time, such as 0.9 s or 2 weeks", "s"};
  static constexpr Kind pressure{{-1, 1, -2}, "a stress", "a stress or modulus, such as 30 GPa", "Pa"};
  static constexpr Kind density{{-3, 1, 0}, "a density", "a density, such as 2700 kg/m3 or 2.7 g/cm3", "kg/m3"};
  static constexpr Kind stiffness{
      {-2, 1, -2}, "a stress over a slip", "a stress over a slip, such as 1 MPa/mm", "Pa/m"};
  static constexpr Kind spring{{0, 1, -2}, "a force over a slip", "a force over a slip, such as 1e6 N/m", "N/m"};
  static constexpr Kind ratio{{0, 0, 0}, "a pure number", "a pure number, such as 0.25"};
  switch (dimension) {
    case Dimension::velocity:
      return velocity;
    case Dimension::length:
      return length;
    case Dimension::area:
      return area;
    case Dimension::moment:
      return moment;
    case Dimension::time:
      return time;
    case Dimension::pressure:
      return pressure;
    case Dimension::density:
      return density;
    case Dimension::stiffness:
      return stiffness;
    case Dimension::spring:
      return spring;
    case Dimension::ratio:
      break;
  }
  return ratio;
}

/// The number that `text` begins with; moves `text` past it.
std::optional<double> take_number(std::string_view& text) {
  std::string_view rest = text;
  if (!rest.empty() && rest.front() == '+') rest.remove_prefix(1);
  double value = 0;
  const auto [end, error] = std::from_chars(rest.data(), rest.data() + rest.size(), value);
  if (error != std::errc{} || !std::isfinite(value)) return std::nullopt;
  text = rest.substr(static_cast<std::size_t>(end - rest.data()));
  return value;
}

}  // namespace

std::string_view si_unit(Dimension dimension) { return kind(dimension).si; }
std::string_view example(Dimension dimension) { return kind(dimension).example; }

std::optional<double> number(std::string_view text) {
  text = trimmed(text);
  const std::optional<double> value = take_number(text);
  return text.empty() ? value : std::nullopt;
}

bool is_unit(std::string_view text) { return parse_unit(text).has_value(); }

std::optional<std::string> unit_of(std::string_view text) {
  const std::string whole = plain_number(text);
  std::string_view rest = whole;
  if (!take_number(rest) || trimmed(rest).empty()) return std::nullopt;
  std::string unit = plain_unit(rest);
  return parse_unit(unit) ? std::optional(std::move(unit)) : std::nullopt;
}

namespace {

/// The usual unit that differs from `unit` only in upper and lower case. Empty if there is none.
std::string_view usual_unit_like(std::string_view unit, const Kind& wanted) {
  static constexpr std::string_view usual[] = {
      "Pa",    "kPa",    "MPa",    "GPa",    "bar",  "m/s",   "km/s", "cm/s", "mm/s",  "um/s",  "mm/yr",
      "cm/yr", "km/day", "mm/day", "m",      "km",   "cm",    "mm",   "um",   "nm",    "km2",   "m2",
      "s",     "ms",     "min",    "hours",  "days", "weeks", "yr",   "N m",  "kg/m3", "g/cm3", "Pa/m",
      "MPa/m", "MPa/um", "GPa/m",  "MPa/mm", "N/m",  "kN/m",  "MN/m", "%"};
  const auto equal = [](char a, char b) {
    return std::tolower(static_cast<unsigned char>(a)) == std::tolower(static_cast<unsigned char>(b));
  };
  for (const std::string_view one : usual)
    if (std::equal(one.begin(), one.end(), unit.begin(), unit.end(), equal) && parse_unit(one)->powers == wanted.powers)
      return one;
  return {};
}

}  // namespace

double unit_factor(std::string_view unit, Dimension dimension) {
  const Kind& wanted = kind(dimension);
  // UDUNITS reads "% km/s" as a hundredth of km/s, which nobody means.
  if (dimension != Dimension::ratio && unit.find('%') != std::string_view::npos)
    throw InputError(
        {.problem = "'%' is not part of the unit of " + std::string(wanted.name), .allowed = wanted.example});
  const std::optional<Unit> parsed = parse_unit(unit);
  const bool is_wanted = parsed && parsed->powers == wanted.powers && parsed->factor > 0;
  const std::string_view usual = is_wanted ? std::string_view() : usual_unit_like(unit, wanted);
  if (!usual.empty())
    throw InputError(
        {.problem = "unknown unit '" + std::string(unit) + "' (did you mean '" + std::string(usual) + "'?)",
         .allowed = wanted.example});
  if (!parsed) throw InputError({.problem = "unknown unit '" + std::string(unit) + "'", .allowed = wanted.example});
  if (parsed->powers != wanted.powers || !(parsed->factor > 0) || !std::isfinite(parsed->factor))
    throw InputError(
        {.problem = "the unit '" + std::string(unit) + "' is not that of " + wanted.name, .allowed = wanted.example});
  return parsed->factor;
}

double column_unit_factor(std::string_view unit, Dimension dimension) {
  const double scale = take_number(unit).value_or(1);
  if (!(scale > 0)) throw InputError({.problem = "the factor of the unit is not positive", .allowed = "> 0"});
  return scale * unit_factor(trimmed(unit), dimension);
}

Span parse_quantity(std::string_view text, Dimension dimension, std::string_view default_unit) {
  const std::string whole = plain_number(text);
  const auto refuse = [&](std::string problem, std::string allowed) {
    return InputError({.value = whole, .problem = std::move(problem), .allowed = std::move(allowed)});
  };
  std::string_view rest = whole;
  const std::optional<double> low = take_number(rest);
  if (!low) throw refuse("not a finite number", kind(dimension).example);
  std::optional<double> high = low;
  rest = trimmed(rest);
  if (rest.size() > 1 && rest.front() == '-') {  // a range, 2-15 km/day
    rest.remove_prefix(1);
    rest = trimmed(rest);
    high = take_number(rest);
    if (!high) throw refuse("not a range of two finite numbers", "low-high unit, such as 2-15 km/day");
    if (*high < *low) throw refuse("the range runs downwards", "low-high unit, such as 2-15 km/day");
    rest = trimmed(rest);
  }
  double factor = 1;
  const std::string unit = rest.empty() ? std::string(default_unit) : plain_unit(rest);
  if (unit.empty() && dimension != Dimension::ratio) throw refuse("a number without a unit", kind(dimension).example);
  if (!unit.empty()) {
    try {
      factor = rest.empty() ? column_unit_factor(unit, dimension) : unit_factor(unit, dimension);
    } catch (const InputError& error) {
      throw refuse(error.complaint().problem, error.complaint().allowed);
    }
  }
  const Span span{*low * factor, *high * factor};
  if (!std::isfinite(span.low) || !std::isfinite(span.high))
    throw refuse("not finite in SI units", kind(dimension).example);
  return span;
}

}  // namespace slipfront::medium
