#include "slipfront/theory/medium/si_units.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <optional>

#include "math/digits.hpp"
#include "slipfront/error.hpp"
#include "slipfront/theory/medium/medium.hpp"
#include "text/characters.hpp"

namespace slipfront::medium {
namespace {

/// Exponents of Pa, m and s.
using Powers = std::array<int, 3>;

struct Symbol {
  std::string_view name;
  double SymbolValues::*value;  ///< null: pi
  Powers powers;
};
/// Longer names before their beginnings.
constexpr Symbol model_symbols[] = {
    {"mu", &SymbolValues::mu, {1, 0, 0}}, {"nu", &SymbolValues::nu, {}},      {"pi", nullptr, {}},
    {"A", &SymbolValues::A, {}},          {"b", &SymbolValues::b, {0, 1, 0}}, {"c", &SymbolValues::c, {0, 1, -1}},
};

struct Amount {
  double value = 1;
  Powers powers = {};
};

/// A parser by recursive descent: sum = product {+|- product}, product = power {[*|/] power}, power = part [^ digit].
class Parser {
 public:
  Parser(std::string_view text, const SymbolValues& values) : all_(text), rest_(text), values_(values) {}

  Amount whole() {
    const Amount amount = product();
    if (next() != '\0') refuse();
    return amount;
  }
  const std::string& found() const { return found_; }

 private:
  [[noreturn]] void refuse() const {
    throw InputError({.key = "dimensional_unit",
                      .value = std::string(all_),
                      .problem = "not a unit of the model",
                      .allowed = "products and powers of mu, nu, pi, A, b, c"});
  }

  char next() {
    while (!rest_.empty() && rest_.front() == ' ') rest_.remove_prefix(1);
    return rest_.empty() ? '\0' : rest_.front();
  }
  bool take(char c) {
    if (next() != c) return false;
    rest_.remove_prefix(1);
    return true;
  }

  Amount product() {
    if (++depth_ > 20) refuse();
    Amount all = power();
    for (char c = next(); c != '\0' && c != ')' && c != '+' && c != '-'; c = next()) {
      const int sign = take('/') ? -1 : 1;
      if (sign > 0) take('*');
      const Amount factor = power();
      all.value = sign > 0 ? all.value * factor.value : all.value / factor.value;
      for (std::size_t i = 0; i < all.powers.size(); ++i) all.powers[i] += sign * factor.powers[i];
    }
    --depth_;
    return all;
  }

  Amount sum() {
    Amount all = product();
    for (char c = next(); c == '+' || c == '-'; c = next()) {
      take(c);
      const Amount other = product();
      if (other.powers != all.powers) refuse();
      all.value += c == '+' ? other.value : -other.value;
    }
    return all;
  }

  Amount power() {
    Amount base = part();
    if (!take('^')) return base;
    const int sign = take('-') ? -1 : 1;
    const int exponent = sign * whole_number();
    if (std::abs(exponent) > 9) refuse();
    base.value = std::pow(base.value, exponent);
    for (int& p : base.powers) p *= exponent;
    return base;
  }

  Amount part() {
    if (take('(')) {
      const Amount inner = sum();
      if (!take(')')) refuse();
      return inner;
    }
    const char c = next();
    if (c >= '0' && c <= '9') return {static_cast<double>(whole_number()), {}};
    for (const Symbol& symbol : model_symbols) {
      if (!rest_.starts_with(symbol.name)) continue;
      rest_.remove_prefix(symbol.name.size());
      if (!rest_.empty() && is_letter(rest_.front())) refuse();
      if (!symbol.value) return {std::numbers::pi, {}};
      found_ += (found_.empty() ? "" : " ") + std::string(symbol.name);
      return {values_.*symbol.value, symbol.powers};
    }
    refuse();
  }

  int whole_number() {
    int number = 0;
    if (const char c = next(); c < '0' || c > '9') refuse();
    for (; !rest_.empty() && rest_.front() >= '0' && rest_.front() <= '9'; rest_.remove_prefix(1)) {
      number = 10 * number + (rest_.front() - '0');
      if (number > 1'000'000) refuse();
    }
    return number;
  }

  std::string_view all_, rest_;
  const SymbolValues& values_;
  std::string found_;
  int depth_ = 0;
};

/// The units of slip, and of its integrals along a line and over a plane. The last two are the seismic moment and its
/// rate.
constexpr std::array<std::string_view, 6> slip_units = {"b / (2 pi)",          "b^2 / (2 pi A)",
                                                        "b^3 / (2 pi A^2)",    "b^2 c / (2 pi A)",
                                                        "mu b^3 / (2 pi A^2)", "mu b^2 c / (2 pi A)"};

/// Usual names of some units. Others are products of Pa, m and s.
std::string name_of(const Powers& powers, bool moment) {
  if (powers == Powers{}) return "1";
  if (powers == Powers{1, 3, 0}) return moment ? "N m" : "J";
  if (powers == Powers{1, 3, -1}) return moment ? "N m s-1" : "W";
  if (powers == Powers{1, 1, 0}) return "J m-2";
  if (powers == Powers{1, 2, 0}) return "J m-1";
  constexpr std::array<const char*, 3> units = {"Pa", "m", "s"};
  std::string name;
  for (std::size_t i = 0; i < units.size(); ++i)
    if (powers[i] != 0)
      name += (name.empty() ? "" : " ") + std::string(units[i]) + (powers[i] == 1 ? "" : std::to_string(powers[i]));
  return name;
}

}  // namespace

UnitInSi in_si(std::string_view unit, const SymbolValues& values) {
  const Amount amount = Parser(unit, values).whole();
  const bool slip = std::find(slip_units.begin(), slip_units.end(), unit) != slip_units.end();
  // Energies and powers are stress times slip, so that those in SI units are of both faces too.
  const bool work = amount.powers[0] == 1 && amount.powers[1] >= 1;
  return {slip || work ? face_factor * amount.value : amount.value, name_of(amount.powers, slip), slip};
}

std::string symbols_of(std::string_view unit) {
  const SymbolValues values{};
  Parser parser(unit, values);
  parser.whole();
  return parser.found();
}

SiUnits::SiUnits(const Constants& medium) {
  std::string missing;
  if (!medium.contact_ratio) missing = "medium.contact_ratio";
  if (!medium.asperity_spacing) missing += (missing.empty() ? "" : " and ") + std::string("medium.asperity_spacing");
  if (!missing.empty())
    throw InputError({.problem = "results in SI units need " + missing,
                      .allowed = missing + ", or results in the units of the model"});
  const Elastic rock = elastic(medium, {}, &assumed_);
  units(rock.shear_modulus, rock.speed, *medium.contact_ratio, *medium.asperity_spacing);  // checks their ranges
  values_ = {rock.shear_modulus, rock.poisson_ratio, *medium.contact_ratio, *medium.asperity_spacing, rock.speed};
}

std::string SiUnits::in_words() const {
  return "A = " + digits(values_.A) + ", b = " + digits(values_.b) + " m, c = " + digits(values_.c) +
         " m/s, mu = " + digits(values_.mu) + " Pa, nu = " + digits(values_.nu);
}

}  // namespace slipfront::medium
