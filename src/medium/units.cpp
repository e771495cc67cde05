#include "medium/units.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>

#include "foundation/text/characters.hpp"
#include "medium/unit_names.hpp"

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

}  // namespace slipfront::medium
