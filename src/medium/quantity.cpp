#include "slipfront/medium/quantity.hpp"

#include <locale.h>
#include <udunits2.h>

#include <charconv>
#include <cmath>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <utility>

#include "../trimmed.hpp"
#include "slipfront/error.hpp"

namespace slipfront::medium {
namespace {

struct Kind {
  const char* si;
  const char* name;
  const char* example;
};

const Kind& kind(Dimension dimension) {
  static constexpr Kind velocity{"m/s", "a velocity", "a velocity, such as 3.0 km/s or 10 km/day"};
  static constexpr Kind length{"m", "a length", "a length, such as 4 mm or 1.2 m"};
  static constexpr Kind time{"s", "a time", "a time, such as 0.9 s or 2 weeks"};
  static constexpr Kind pressure{"Pa", "a stress", "a stress or modulus, such as 30 GPa"};
  static constexpr Kind density{"kg/m3", "a density", "a density, such as 2700 kg/m3 or 2.7 g/cm3"};
  static constexpr Kind ratio{"1", "a pure number", "a pure number, such as 0.25"};
  switch (dimension) {
    case Dimension::velocity:
      return velocity;
    case Dimension::length:
      return length;
    case Dimension::time:
      return time;
    case Dimension::pressure:
      return pressure;
    case Dimension::density:
      return density;
    case Dimension::ratio:
      break;
  }
  return ratio;
}

struct Free {
  void operator()(ut_unit* unit) const { ut_free(unit); }
  void operator()(cv_converter* converter) const { cv_free(converter); }
};
using Unit = std::unique_ptr<ut_unit, Free>;
using Converter = std::unique_ptr<cv_converter, Free>;

/// UDUNITS reads numbers as the locale writes them, and its database writes them with a point.
class PlainLocale {
 public:
  PlainLocale() : plain_(newlocale(LC_ALL_MASK, "C", nullptr)), before_(plain_ ? uselocale(plain_) : nullptr) {}
  ~PlainLocale() {
    if (!plain_) return;
    uselocale(before_);
    freelocale(plain_);
  }
  PlainLocale(const PlainLocale&) = delete;
  PlainLocale& operator=(const PlainLocale&) = delete;

 private:
  locale_t plain_, before_;
};

/// The unit database, read once and kept for the life of the process.
ut_system* unit_system() {
  static ut_system* const system = [] {
    ut_set_error_message_handler(ut_ignore);
    ut_system* read = ut_read_xml(nullptr);
    if (!read) throw FileError("the UDUNITS-2 unit database cannot be read (Debian package libudunits2-data)");
    return read;
  }();
  return system;
}

bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }
bool is_digit(char c) { return c >= '0' && c <= '9'; }

/// Moves past one factor, a name with an optional exponent: `km`, `s-1`, `cm^3`, `%`.
bool take_factor(std::string_view& text) {
  std::size_t size = 0;
  while (size < text.size() && is_letter(text[size])) ++size;
  if (size == 0 && !text.empty() && text.front() == '%') size = 1;
  // Words of the UDUNITS grammar that are no names.
  for (const std::string_view word : {"per", "PER", "since", "SINCE", "after", "AFTER", "from", "FROM", "ref", "REF"})
    if (text.substr(0, size) == word) return false;
  if (size == 0) return false;
  text.remove_prefix(size);
  const bool caret = !text.empty() && text.front() == '^';
  const std::size_t sign = caret ? 1 : 0;
  const std::size_t digit = sign + (text.size() > sign && text[sign] == '-' ? 1 : 0);
  if (text.size() > digit && is_digit(text[digit])) {
    text.remove_prefix(digit + 1);
    return true;
  }
  return !caret;
}

/// Factors joined by '/', '*', '.' or one blank. Narrower than what UDUNITS parses ("10 km" is a quantity, not a unit),
/// and whatever passes is no syntax error there: those leak memory inside it.
bool may_be_unit(std::string_view text) {
  if (text.size() > 40 || !take_factor(text)) return false;
  while (!text.empty()) {
    if (std::string_view("/*. ").find(text.front()) == std::string_view::npos) return false;
    text.remove_prefix(1);
    if (!take_factor(text)) return false;
  }
  return true;
}

double look_up(const std::string& unit, Dimension dimension) {
  const Kind& wanted = kind(dimension);
  const PlainLocale locale;
  ut_system* const system = unit_system();
  const Unit from{may_be_unit(unit) ? ut_parse(system, unit.c_str(), UT_ASCII) : nullptr};
  if (!from) throw InputError({.problem = "unknown unit '" + unit + "'", .allowed = wanted.example});
  const Unit to{ut_parse(system, wanted.si, UT_ASCII)};
  const Converter converter{ut_are_convertible(from.get(), to.get()) ? ut_get_converter(from.get(), to.get())
                                                                     : nullptr};
  const double factor = converter ? cv_convert_double(converter.get(), 1.0) : 0.0;
  const double offset = converter ? cv_convert_double(converter.get(), 0.0) : 0.0;
  if (!(factor > 0) || !std::isfinite(factor) || offset != 0)
    throw InputError({.problem = "the unit '" + unit + "' is not that of " + wanted.name, .allowed = wanted.example});
  return factor;
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

std::string_view example(Dimension dimension) { return kind(dimension).example; }

std::optional<double> number(std::string_view text) {
  text = trimmed(text);
  const std::optional<double> value = take_number(text);
  return text.empty() ? value : std::nullopt;
}

double unit_factor(std::string_view unit, Dimension dimension) {
  static std::mutex mutex;  // UDUNITS keeps global state
  static std::map<std::pair<std::string, Dimension>, double> known;
  const std::scoped_lock lock(mutex);
  const std::pair key{std::string(unit), dimension};
  if (const auto found = known.find(key); found != known.end()) return found->second;
  const double factor = look_up(key.first, dimension);
  if (known.size() < 1000) known.emplace(key, factor);
  return factor;
}

Span parse_quantity(std::string_view text, Dimension dimension, std::string_view default_unit) {
  const std::string whole(trimmed(text));
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
  const std::string_view unit = rest.empty() ? default_unit : rest;
  if (unit.empty() && dimension != Dimension::ratio) throw refuse("a number without a unit", kind(dimension).example);
  if (!unit.empty()) {
    try {
      factor = unit_factor(unit, dimension);
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
