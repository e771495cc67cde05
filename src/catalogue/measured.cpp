#include "slipfront/catalogue/measured.hpp"

#include <algorithm>
#include <boost/math/special_functions/erf.hpp>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>

#include "foundation/text/nearest.hpp"
#include "foundation/text/trimmed.hpp"
#include "slipfront/error.hpp"

namespace slipfront::catalogue {
namespace {

using Shape = Measured::Shape;

constexpr const char* forms =
    "such as 3.0 +- 0.2 km/s, 3.0 +- 10 % km/s, 3.0 */ 1.2 km/s, 2.8..3.2 km/s, lognormal(3.0, 1.2) km/s";

/// The parts of a text such as "3.0 +- 0.2 km/s", before its numbers and its unit are read.
struct Parts {
  std::string_view first, second, unit;
  Shape shape;
  bool percent = false;  ///< the second number is a percentage of the first
};

/// Splits "b unit" after the number b. The split is where a blank or a unit begins, never inside a number such as
/// "1e400".
std::pair<std::string_view, std::string_view> number_and_unit(std::string_view text) {
  const std::size_t end = std::min(text.find_first_not_of("+-.0123456789eE"), text.size());
  if (medium::number(text.substr(0, end))) return {text.substr(0, end), trimmed(text.substr(end))};
  return {text, {}};
}

std::optional<Parts> named(std::string_view text) {
  const auto open = text.find('('), comma = text.find(',', open), close = text.find(')', open);
  if (open == std::string::npos) return std::nullopt;
  const std::string name(trimmed(text.substr(0, open)));
  const bool known = name == "normal" || name == "lognormal" || name == "uniform";
  if (!known || comma == std::string::npos || close == std::string::npos || close < comma)
    throw InputError(
        {.problem = known ? "not two numbers in parentheses" : "unknown distribution '" + name + "'",
         .allowed = known ? std::string(forms) : nearest_or_all(name, {"normal", "lognormal", "uniform"})});
  return Parts{trimmed(text.substr(open + 1, comma - open - 1)), trimmed(text.substr(comma + 1, close - comma - 1)),
               trimmed(text.substr(close + 1)),
               name == "normal"      ? Shape::normal
               : name == "lognormal" ? Shape::lognormal
                                     : Shape::range};
}

std::optional<Parts> with_sign(std::string_view text) {
  static constexpr std::pair<std::string_view, Shape> signs[] = {{"+-", Shape::normal},
                                                                 {"+/-", Shape::normal},
                                                                 {"\xC2\xB1", Shape::normal},
                                                                 {"*/", Shape::lognormal},
                                                                 {"..", Shape::range}};
  for (const auto& [sign, shape] : signs) {
    const auto at = text.find(sign);
    if (at == std::string::npos) continue;
    auto [second, unit] = number_and_unit(trimmed(text.substr(at + sign.size())));
    const bool percent = shape == Shape::normal && unit.starts_with('%');
    if (percent) unit = trimmed(unit.substr(1));
    return Parts{trimmed(text.substr(0, at)), second, unit, shape, percent};
  }
  return std::nullopt;
}

double value_of(std::string_view number, std::string_view unit, medium::Dimension dimension,
                std::string_view default_unit) {
  if (!medium::number(number))
    throw InputError({.problem = "'" + std::string(number) + "' is not a finite number", .allowed = forms});
  return medium::parse_quantity(std::string(number) + " " + std::string(unit), dimension, default_unit).low;
}

/// A normal error that is given as a percentage of the value, as in "2.7 +- 10 % km/s".
Measured in_percent(double value, const Parts& parts, medium::Dimension dimension) {
  const auto percent = medium::number(parts.second);
  if (!percent || !(*percent > 0))
    throw InputError({.problem = "the uncertainty is " + std::string(parts.second) + " %", .allowed = "> 0 %"});
  if (dimension == medium::Dimension::ratio)
    throw InputError({.problem = "a percentage of a pure number has two readings",
                      .allowed = "the uncertainty as a number, such as 0.30 +- 0.03"});
  return {value, value, Shape::normal, *percent / 100 * std::fabs(value)};
}

Measured measured(const Parts& parts, medium::Dimension dimension, std::string_view default_unit) {
  const double first = value_of(parts.first, parts.unit, dimension, default_unit);
  if (parts.shape == Shape::lognormal) {
    const auto factor = medium::number(parts.second);
    if (!factor || !(*factor > 1))
      throw InputError(
          {.problem = "the factor of a lognormal distribution is " + std::string(parts.second), .allowed = "> 1"});
    return {first, first, Shape::lognormal, *factor};
  }
  if (parts.percent) return in_percent(first, parts, dimension);
  const double second = value_of(parts.second, parts.unit, dimension, default_unit);
  if (parts.shape == Shape::range) {
    if (second < first) throw InputError({.problem = "the range runs downwards", .allowed = "low..high"});
    return {first, second};
  }
  if (!(second > 0)) throw InputError({.problem = "the uncertainty is " + std::string(parts.second), .allowed = "> 0"});
  return {first, first, Shape::normal, second};
}

}  // namespace

double Measured::quantile(double p) const {
  if (shape == Shape::range) return low + p * (high - low);
  const double z = -std::numbers::sqrt2 * boost::math::erfc_inv(2 * p);
  return shape == Shape::normal ? low + spread * z : low * std::exp(std::log(spread) * z);
}

double Measured::share_below(double x) const {
  if (is_exact()) return x > low ? 1 : 0;
  if (shape == Shape::range) return std::clamp((x - low) / (high - low), 0.0, 1.0);
  if (!(x > 0) && shape == Shape::lognormal) return 0;
  const double z = shape == Shape::normal ? (x - low) / spread : std::log(x / low) / std::log(spread);
  return std::erfc(-z / std::numbers::sqrt2) / 2;
}

double Measured::likelihood(double x) const {
  if (shape == Shape::range) return x >= low && x <= high ? 1 : 0;
  if (!(x > 0) && shape == Shape::lognormal) return 0;
  const double z = shape == Shape::normal ? (x - low) / spread : std::log(x / low) / std::log(spread);
  const double fall = shape == Shape::normal && x < least_even_share * low ? x / (least_even_share * low) : 1;
  return fall * std::exp(-z * z / 2);
}

double Measured::likelihood_of_log(double ln_x) const {
  if (shape != Shape::lognormal) return likelihood(std::exp(ln_x));
  const double z = (ln_x - std::log(low)) / std::log(spread);
  return std::exp(-z * z / 2);
}

Measured parse_measured(std::string_view text, medium::Dimension dimension, std::string_view default_unit) {
  const std::string whole(trimmed(text));
  try {
    if (const auto parts = named(whole)) return measured(*parts, dimension, default_unit);
    if (const auto parts = with_sign(whole)) return measured(*parts, dimension, default_unit);
  } catch (const InputError& error) {
    Complaint c = error.complaint();
    c.value = whole;
    throw InputError(c);
  }
  const medium::Span span = medium::parse_quantity(whole, dimension, default_unit);
  return {span.low, span.high};
}

}  // namespace slipfront::catalogue
