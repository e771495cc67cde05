#include "slipfront/text/quantity.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>

#include "math/digits.hpp"
#include "slipfront/error.hpp"
#include "text/characters.hpp"
#include "text/unit_names.hpp"
#include "text/units.hpp"

namespace slipfront::medium {
namespace {

struct Prefix {
  std::string_view name, symbol;
  double factor;
};

/// "da" before "d".
constexpr Prefix prefixes[] = {
    {"yotta", "Y", 1e24}, {"zetta", "Z", 1e21},  {"exa", "E", 1e18},   {"peta", "P", 1e15},   {"tera", "T", 1e12},
    {"giga", "G", 1e9},   {"mega", "M", 1e6},    {"kilo", "k", 1e3},   {"hecto", "h", 100},   {"deka", "da", 10},
    {"deci", "d", 0.1},   {"centi", "c", 0.01},  {"milli", "m", 1e-3}, {"micro", "u", 1e-6},  {"nano", "n", 1e-9},
    {"pico", "p", 1e-12}, {"femto", "f", 1e-15}, {"atto", "a", 1e-18}, {"zepto", "z", 1e-21}, {"yocto", "y", 1e-24}};

const Unit* find(std::span<const NamedUnit> table, std::string_view name) {
  const auto at = std::lower_bound(table.begin(), table.end(), name,
                                   [](const NamedUnit& unit, std::string_view wanted) { return unit.name < wanted; });
  return at != table.end() && at->name == name ? &at->unit : nullptr;
}

/// The prefix that `text` begins with, if any.
const Prefix* find_prefix(std::string_view text, std::string_view Prefix::*kind) {
  for (const Prefix& prefix : prefixes)
    if (text.starts_with(prefix.*kind)) return &prefix;
  return nullptr;
}

/// A name or a symbol behind prefixes, of which one may be a symbol.
std::optional<Unit> named(std::string_view word) {
  const std::string lowered = small_letters(word);
  double factor = 1;
  bool may_be_symbol = true;
  for (std::string_view small = lowered; !word.empty(); small.remove_prefix(small.size() - word.size())) {
    const Unit* unit = find(unit_names, small);
    if (!unit) unit = find(unit_symbols, word);
    if (unit) return Unit{factor * unit->factor, unit->powers};
    const Prefix* prefix = find_prefix(small, &Prefix::name);
    if (prefix) {
      word.remove_prefix(prefix->name.size());
    } else {
      prefix = may_be_symbol ? find_prefix(word, &Prefix::symbol) : nullptr;
      if (!prefix) return std::nullopt;
      may_be_symbol = false;
      word.remove_prefix(prefix->symbol.size());
    }
    factor *= prefix->factor;
  }
  return std::nullopt;
}

/// The factor that `text` begins with, a name with an optional exponent; moves `text` past it.
std::optional<Unit> take_factor(std::string_view& text) {
  std::size_t size = 0;
  while (size < text.size() && is_letter(text[size])) ++size;
  if (size == 0 && !text.empty() && text.front() == '%') size = 1;
  std::optional<Unit> unit = named(text.substr(0, size));
  text.remove_prefix(size);
  const bool caret = !text.empty() && text.front() == '^';
  const std::size_t sign = caret ? 1 : 0;
  const std::size_t digit = sign + (text.size() > sign && text[sign] == '-' ? 1 : 0);
  if (text.size() <= digit || !is_digit(text[digit])) return caret ? std::nullopt : unit;
  const int exponent = (digit > sign ? -1 : 1) * (text[digit] - '0');
  text.remove_prefix(digit + 1);
  if (!unit) return std::nullopt;
  unit->factor = std::pow(unit->factor, exponent);
  for (int& power : unit->powers) power *= exponent;
  return unit;
}

}  // namespace

std::optional<Unit> parse_unit(std::string_view text) {
  Unit product;
  for (int sign = 1;;) {
    const std::optional<Unit> unit = take_factor(text);
    if (!unit) return std::nullopt;
    product.factor *= sign > 0 ? unit->factor : 1 / unit->factor;
    for (std::size_t i = 0; i < product.powers.size(); ++i) product.powers[i] += sign * unit->powers[i];
    if (text.empty()) return product;
    if (std::string_view("/*. ").find(text.front()) == std::string_view::npos) return std::nullopt;
    sign = text.front() == '/' ? -1 : 1;
    text.remove_prefix(1);
  }
}

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

namespace {

void replace_all(std::string& text, std::string_view from, std::string_view to) {
  for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size()))
    text.replace(at, from.size(), to);
}

constexpr std::pair<std::string_view, std::string_view> characters[] = {
    {"\xC2\xA0", " "},                 // no-break space
    {"\xE2\x80\x89", " "},             // thin space
    {"\xE2\x80\xAF", " "},             // narrow no-break space
    {"\xE2\x88\x92", "-"},             // minus sign
    {"\xE2\x80\x90", "-"},             // hyphen
    {"\xE2\x80\x91", "-"},             // non-breaking hyphen
    {"\xE2\x81\xBB", "-"},             // superscript minus
    {"\xC2\xB7", " "},                 // middle dot
    {"\xE2\x8B\x85", " "},             // dot operator
    {"\xC2\xB5", "u"},                 // micro sign
    {"\xCE\xBC", "u"},                 // Greek mu
    {"\xC3\x97", "x"},                 // multiplication sign
    {"\xE2\x89\xA4", "<"},             // less or equal
    {"\xE2\x89\xA5", ">"},             // greater or equal
    {"\xE2\x89\x88", "~"},             // almost equal
    {"\xE2\x80\x94", "\xE2\x80\x93"},  // em dash -> en dash
    {"\xE2\x80\x92", "\xE2\x80\x93"},  // figure dash -> en dash
};
constexpr std::string_view superscripts[] = {"\xE2\x81\xB0", "\xC2\xB9",     "\xC2\xB2",     "\xC2\xB3",
                                             "\xE2\x81\xB4", "\xE2\x81\xB5", "\xE2\x81\xB6", "\xE2\x81\xB7",
                                             "\xE2\x81\xB8", "\xE2\x81\xB9"};

/// Replaces typographic characters. A superscript after "10" is an exponent.
std::string plain_characters(std::string_view text) {
  std::string plain(text);
  if (std::all_of(plain.begin(), plain.end(), [](char c) { return static_cast<unsigned char>(c) < 0x80; }))
    return plain;
  replace_all(plain, "10\xE2\x81\xBB", "10^-");  // a superscript minus
  for (const auto& digit : superscripts) replace_all(plain, "10" + std::string(digit), "10^" + std::string(digit));
  for (std::size_t i = 0; i < std::size(superscripts); ++i)
    replace_all(plain, superscripts[i], std::string(1, static_cast<char>('0' + i)));
  for (const auto& [from, to] : characters) replace_all(plain, from, to);
  return plain;
}

/// "1.2 x 10^18" -> "1.2e18".
void join_powers_of_ten(std::string& text) {
  for (std::size_t at = text.find("10^"); at != std::string::npos; at = text.find("10^", at + 1)) {
    std::size_t begin = at;
    while (begin > 0 && text[begin - 1] == ' ') --begin;
    if (begin == 0 || std::string_view("xX*").find(text[begin - 1]) == std::string_view::npos) continue;
    --begin;
    while (begin > 0 && text[begin - 1] == ' ') --begin;
    if (begin > 0 && (is_digit(text[begin - 1]) || text[begin - 1] == '.')) text.replace(begin, at + 3 - begin, "e");
  }
}

/// A dash or the word "to" between two numbers is a range; a dash before a number is its sign.
void join_ranges(std::string& text) {
  for (const std::string_view word : {"\xE2\x80\x93", " to "}) {
    for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) {
      const std::string_view after = trimmed(std::string_view(text).substr(at + word.size()));
      const std::string_view before = trimmed(std::string_view(text).substr(0, at));
      const bool number_follows = !after.empty() && (is_digit(after.front()) || after.front() == '.');
      if (number_follows) text.replace(at, word.size(), before.empty() ? "-" : " .. ");
    }
  }
}

bool is_known(std::string_view unit) { return parse_unit(unit).has_value(); }

}  // namespace

std::string plain_number(std::string_view text) {
  std::string plain = plain_characters(text);
  join_powers_of_ten(plain);
  join_ranges(plain);
  return std::string(trimmed(plain));
}

std::string plain_unit(std::string_view text) {
  std::string unit = plain_characters(trimmed(text));
  if (unit.size() > 1 && ((unit.front() == '(' && unit.back() == ')') || (unit.front() == '[' && unit.back() == ']')))
    unit = unit.substr(1, unit.size() - 2);
  unit = trimmed(unit);
  for (const auto& [from, to] : {std::pair<std::string_view, std::string_view>{"Nm", "N m"},
                                 {"N-m", "N m"},
                                 {"dyn-cm", "dyne cm"},
                                 {"dyne-cm", "dyne cm"},
                                 {"dyn cm", "dyne cm"},
                                 {"dyncm", "dyne cm"},
                                 {"dyn.cm", "dyne cm"},
                                 {"dyn*cm", "dyne cm"}})
    if (unit == from) return std::string(to);
  if (unit.empty() || is_known(unit)) return unit;
  std::string small = small_letters(unit);
  replace_all(small, "hrs", "hr");
  replace_all(small, "yrs", "yr");
  replace_all(small, "secs", "s");
  if (small == "wk" || small == "wks") small = "week";
  if (small == "mins") small = "min";
  if (is_known(small)) return small;
  return unit;
}

std::string plain_column_unit(std::string_view text) {
  std::string plain = plain_number(text);
  if (plain.starts_with('x')) plain = trimmed(std::string_view(plain).substr(1));
  if (plain.starts_with("10^")) plain.replace(0, 3, "1e");
  const auto blank = plain.find(' ');
  const auto scale = number(std::string_view(plain).substr(0, blank));
  const std::string unit = scale && blank != std::string::npos ? plain_unit(plain.substr(blank)) : "";
  if (!is_known(unit) || !(*scale > 0)) return plain_unit(text);
  std::string factor = shortest(*scale);
  factor.erase(std::remove(factor.begin(), factor.end(), '+'), factor.end());
  return factor + " " + unit;
}

}  // namespace slipfront::medium
