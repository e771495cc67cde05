#include "slipfront/events/catalogue/measured.hpp"

#include <algorithm>
#include <boost/math/special_functions/erf.hpp>
#include <charconv>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>

#include "math/digits.hpp"
#include "slipfront/error.hpp"
#include "slipfront/events/catalogue/observation.hpp"
#include "slipfront/text/quantity.hpp"
#include "text/characters.hpp"
#include "text/units.hpp"

namespace slipfront::catalogue {
namespace {

/// The standard normal deviate that is below with probability p.
double deviate(double p) { return -std::numbers::sqrt2 * boost::math::erfc_inv(2 * p); }

}  // namespace

double MeasuredValue::quantile(double p) const {
  switch (shape) {
    case Shape::range:
      break;
    case Shape::normal:
      return low + spread * deviate(p);
    case Shape::lognormal:
      return low * std::exp(std::log(spread) * deviate(p));
    case Shape::split: {
      const double below = spread_below / (spread_below + spread);
      return p < below ? low + spread_below * deviate(p / below / 2)
                       : low - spread * deviate((1 - p) / (1 - below) / 2);
    }
  }
  return low + p * (high - low);
}

double MeasuredValue::share_below(double x) const {
  const auto below = [](double z) { return std::erfc(-z / std::numbers::sqrt2) / 2; };
  switch (shape) {
    case Shape::range:
      break;
    case Shape::normal:
      return below((x - low) / spread);
    case Shape::lognormal:
      return x > 0 ? below(std::log(x / low) / std::log(spread)) : 0;
    case Shape::split: {
      const double under = spread_below / (spread_below + spread);
      return x < low ? 2 * under * below((x - low) / spread_below) : 1 - 2 * (1 - under) * below((low - x) / spread);
    }
  }
  if (is_exact()) return x > low ? 1 : 0;
  return std::clamp((x - low) / (high - low), 0.0, 1.0);
}

double MeasuredValue::likelihood(double x) const {
  double z = 0;
  switch (shape) {
    case Shape::range:
      return x >= low && x <= high ? 1 : 0;
    case Shape::normal:
      z = (x - low) / spread;
      break;
    case Shape::lognormal:
      if (!(x > 0)) return 0;
      z = std::log(x / low) / std::log(spread);
      break;
    case Shape::split:
      z = (x - low) / (x < low ? spread_below : spread);
      break;
  }
  const bool falls = shape != Shape::lognormal && x < least_even_share * low;
  return (falls ? x / (least_even_share * low) : 1) * std::exp(-z * z / 2);
}

double MeasuredValue::likelihood_of_log(double ln_x) const {
  if (shape != Shape::lognormal) return likelihood(std::exp(ln_x));
  const double z = (ln_x - std::log(low)) / std::log(spread);
  return std::exp(-z * z / 2);
}

namespace {

using Shape = MeasuredValue::Shape;

constexpr const char* forms =
    "such as 3.0 +- 0.2 km/s, 3.0 +- 10 % km/s, 3.0 +0.3/-0.1 km/s, 3.0(2) km/s, 3.0 */ 1.2 km/s, 2.8..3.2 km/s, "
    "lognormal(3.0, 1.2) km/s";

/// The parts of a text such as "3.0 +- 0.2 km/s", before its numbers and its unit are read.
struct ValueParts {
  std::string first, second, unit;
  Shape shape;
  bool percent = false;    ///< the second number is a percentage of the first
  std::string third = {};  ///< the error below the value, if `second` is only that above
};

/// Removes the number that `text` begins with, and returns it as it is written. Empty if there is none.
std::string take_number(std::string_view& text, bool may_have_sign) {
  std::string_view rest = text;
  const bool has_sign = !rest.empty() && (rest.front() == '+' || rest.front() == '-');
  if (has_sign && !may_have_sign) return {};
  if (has_sign) rest.remove_prefix(1);
  if (rest.empty() || !(is_digit(rest.front()) || rest.front() == '.')) return {};
  double value = 0;
  const char* end = std::from_chars(rest.data(), rest.data() + rest.size(), value).ptr;
  std::string number(text.substr(0, static_cast<std::size_t>(end - text.data())));
  text.remove_prefix(number.size());
  return number;
}

/// Splits "b unit" after the number b. The split is where a blank or a unit begins, never inside a number such as
/// "1e400".
std::pair<std::string, std::string> number_and_unit(std::string_view text) {
  const std::size_t end = std::min(text.find_first_not_of("+-.0123456789eE"), text.size());
  if (medium::number(text.substr(0, end)))
    return {std::string(text.substr(0, end)), std::string(trimmed(text.substr(end)))};
  return {std::string(text), {}};
}

/// The unit of a text that may give it behind both numbers.
std::string one_unit(std::string_view a, std::string_view b) {
  const std::string first(trimmed(a)), second(trimmed(b));
  if (!first.empty() && !second.empty() && medium::plain_unit(first) != medium::plain_unit(second))
    throw InputError({.problem = "two units, '" + first + "' and '" + second + "'", .allowed = forms});
  return first.empty() ? second : first;
}

/// "2.70(12) km/s": the digits in parentheses are the error of the last digits.
std::optional<ValueParts> concise(std::string_view text) {
  std::string_view rest = text;
  const std::string first = take_number(rest, true);
  if (first.empty()) return std::nullopt;
  const auto open = rest.find('('), close = rest.find(')', open);
  if (open == std::string_view::npos) return std::nullopt;
  const std::string_view inside =
      trimmed(rest.substr(open + 1, close == std::string_view::npos ? close : close - open - 1));
  const bool adjoins = open == 0 && close != std::string_view::npos && !inside.empty();
  if (!adjoins || !std::all_of(inside.begin(), inside.end(), is_digit) ||
      first.find_first_of("eE") != std::string::npos)
    throw InputError({.problem = "the parentheses are not understood", .allowed = forms});
  const auto point = first.find('.');
  const std::size_t decimals = point == std::string::npos ? 0 : first.size() - point - 1;
  return ValueParts{first, std::string(inside) + "e-" + std::to_string(decimals),
                    std::string(trimmed(rest.substr(close + 1))), Shape::normal};
}

/// Removes the sign and the number behind it. Empty if they are not there.
std::string take_error(std::string_view& text, char sign) {
  text = trimmed(text);
  if (text.empty() || text.front() != sign) return {};
  text.remove_prefix(1);
  text = trimmed(text);
  return take_number(text, false);
}

/// "2.7 +0.3/-0.1 km/s", "2.7 (-0.1, +0.3) km/s": unequal errors, in any order.
std::optional<ValueParts> unequal(std::string_view text) {
  std::string_view rest = text;
  ValueParts parts{take_number(rest, true), {}, {}, Shape::split};
  if (parts.first.empty()) return std::nullopt;
  const auto open = rest.find('('), plus = rest.find('+');
  if (plus == std::string_view::npos) return std::nullopt;
  const bool in_parentheses = open != std::string_view::npos && open < plus;
  std::size_t begin = in_parentheses ? open : plus;
  if (!in_parentheses && trimmed(rest).front() == '-') begin = rest.find('-');
  const std::string_view unit = rest.substr(0, begin);
  rest.remove_prefix(in_parentheses ? begin + 1 : begin);
  const bool plus_first = trimmed(rest).starts_with('+');
  (plus_first ? parts.second : parts.third) = take_error(rest, plus_first ? '+' : '-');
  rest = trimmed(rest);
  if (rest.starts_with('/') || rest.starts_with(',')) rest.remove_prefix(1);
  (plus_first ? parts.third : parts.second) = take_error(rest, plus_first ? '-' : '+');
  rest = trimmed(rest);
  if (parts.second.empty() || parts.third.empty() || in_parentheses != rest.starts_with(')')) return std::nullopt;
  if (in_parentheses) rest.remove_prefix(1);
  parts.unit = one_unit(unit, rest);
  return parts;
}

std::optional<ValueParts> named(std::string_view text) {
  const auto open = text.find('('), comma = text.find(',', open), close = text.find(')', open);
  if (open == std::string::npos) return std::nullopt;
  const std::string name(trimmed(text.substr(0, open)));
  const bool known = name == "normal" || name == "lognormal" || name == "uniform";
  if (!known || comma == std::string::npos || close == std::string::npos || close < comma)
    throw InputError(
        {.problem = known ? "not two numbers in parentheses" : "unknown distribution '" + name + "'",
         .allowed = known ? std::string(forms) : nearest_or_all(name, {"normal", "lognormal", "uniform"})});
  return ValueParts{std::string(trimmed(text.substr(open + 1, comma - open - 1))),
                    std::string(trimmed(text.substr(comma + 1, close - comma - 1))),
                    std::string(trimmed(text.substr(close + 1))),
                    name == "normal"      ? Shape::normal
                    : name == "lognormal" ? Shape::lognormal
                                          : Shape::range};
}

std::optional<ValueParts> with_sign(std::string_view text) {
  static constexpr std::pair<std::string_view, Shape> signs[] = {{"+-", Shape::normal},
                                                                 {"+/-", Shape::normal},
                                                                 {"\xC2\xB1", Shape::normal},
                                                                 {"*/", Shape::lognormal},
                                                                 {"..", Shape::range}};
  for (const auto& [sign, shape] : signs) {
    const auto at = text.find(sign);
    if (at == std::string::npos) continue;
    auto [first, unit_of_first] = number_and_unit(trimmed(text.substr(0, at)));
    auto [second, unit] = number_and_unit(trimmed(text.substr(at + sign.size())));
    const bool percent = shape == Shape::normal && unit.starts_with('%');
    if (percent) unit.erase(0, 1);
    return ValueParts{first, second, one_unit(unit_of_first, unit), shape, percent};
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
MeasuredValue in_percent(double value, const ValueParts& parts, medium::Dimension dimension) {
  const auto percent = medium::number(parts.second);
  if (!percent || !(*percent > 0))
    throw InputError({.problem = "the uncertainty is " + parts.second + " %", .allowed = "> 0 %"});
  if (dimension == medium::Dimension::ratio)
    throw InputError({.problem = "a percentage of a pure number has two readings",
                      .allowed = "the uncertainty as a number, such as 0.30 +- 0.03"});
  return {value, value, Shape::normal, *percent / 100 * std::fabs(value)};
}

MeasuredValue measured(const ValueParts& parts, medium::Dimension dimension, std::string_view default_unit) {
  const double first = value_of(parts.first, parts.unit, dimension, default_unit);
  if (parts.shape == Shape::lognormal) {
    const auto factor = medium::number(parts.second);
    if (!factor || !(*factor > 1))
      throw InputError({.problem = "the factor of a lognormal distribution is " + parts.second, .allowed = "> 1"});
    return {first, first, Shape::lognormal, *factor};
  }
  if (parts.percent) return in_percent(first, parts, dimension);
  const double second = value_of(parts.second, parts.unit, dimension, default_unit);
  if (parts.shape == Shape::range) {
    if (second < first) throw InputError({.problem = "the range runs downwards", .allowed = "low..high"});
    return {first, second};
  }
  if (!(second > 0)) throw InputError({.problem = "the uncertainty is " + parts.second, .allowed = "> 0"});
  if (parts.shape == Shape::normal) return {first, first, Shape::normal, second};
  return split(first, second, value_of(parts.third, parts.unit, dimension, default_unit));
}

/// Refuses "2,7 km/s", a number or a range with a comma inside.
void refuse_comma(std::string_view text) {
  if (take_number(text, true).empty()) return;
  std::string_view after = trimmed(text);
  if (after.starts_with('-')) {
    after = trimmed(after.substr(1));
    if (take_number(after, true).empty()) return;
    after = trimmed(after);
  }
  if (after.size() > 1 && after.front() == ',' && is_digit(after[1]))
    throw InputError({.problem = "a comma inside a number",
                      .allowed = "a decimal point, or in a table the line '# decimal: ,' before the header"});
}

}  // namespace

MeasuredValue split(double value, double above, double below) {
  if (!(above > 0) || !(below > 0))
    throw InputError({.problem = "an error is not positive", .allowed = "> 0, as in 3.0 +0.3/-0.1 km/s"});
  if (above == below) return {value, value, Shape::normal, above};
  return {value, value, Shape::split, above, below};
}

MeasuredValue parse_measured(std::string_view text, medium::Dimension dimension, std::string_view default_unit) {
  const std::string written(trimmed(text)), whole = medium::plain_number(text);
  try {
    if (const auto parts = unequal(whole)) return measured(*parts, dimension, default_unit);
    if (const auto parts = concise(whole)) return measured(*parts, dimension, default_unit);
    if (const auto parts = named(whole)) return measured(*parts, dimension, default_unit);
    if (const auto parts = with_sign(whole)) return measured(*parts, dimension, default_unit);
    refuse_comma(whole);
    const medium::Span span = medium::parse_quantity(whole, dimension, default_unit);
    return {span.low, span.high};
  } catch (const InputError& error) {
    Complaint c = error.complaint();
    c.value = written;
    throw InputError(c);
  }
}

std::optional<Bound> parse_bound(std::string_view text, medium::Dimension dimension, std::string_view default_unit) {
  const std::string whole = medium::plain_number(text);
  if (whole.empty() || (whole.front() != '<' && whole.front() != '>')) return std::nullopt;
  std::string_view rest = std::string_view(whole).substr(1);
  if (rest.starts_with('=')) rest.remove_prefix(1);
  const MeasuredValue limit = parse_measured(rest, dimension, default_unit);
  if (!limit.is_exact())
    throw InputError(
        {.value = std::string(trimmed(text)), .problem = "a bound with an error", .allowed = "one number"});
  return Bound{{}, whole.front() == '<', limit.low};
}

const char* name_of(RuptureVelocityIs meaning) {
  return meaning == RuptureVelocityIs::front ? "front" : "characteristic";
}

const char* name_of(StressDropIs meaning) { return meaning == StressDropIs::static_drop ? "static" : "stored"; }

RuptureVelocityIs rupture_velocity_meaning(std::string_view name) {
  for (const auto meaning : {RuptureVelocityIs::front, RuptureVelocityIs::characteristic})
    if (name == name_of(meaning)) return meaning;
  throw InputError({.value = std::string(name), .problem = "unknown", .allowed = "front, characteristic"});
}

StressDropIs stress_drop_meaning(std::string_view name) {
  for (const auto meaning : {StressDropIs::static_drop, StressDropIs::stored})
    if (name == name_of(meaning)) return meaning;
  throw InputError({.value = std::string(name), .problem = "unknown", .allowed = "static, stored"});
}

double parse_front_threshold(std::string_view text) {
  const auto value = medium::number(text);
  if (!value || !(*value >= least_front_threshold && *value <= most_front_threshold))
    throw InputError({.value = std::string(text),
                      .problem = value ? "out of range" : "not a number",
                      .allowed = digits(least_front_threshold) + " ... " + digits(most_front_threshold)});
  return *value;
}

}  // namespace slipfront::catalogue
