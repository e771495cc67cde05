#include "catalogue/csv/csv_header.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "catalogue/csv/csv_names.hpp"
#include "catalogue/csv/csv_title.hpp"
#include "foundation/text/nearest.hpp"
#include "foundation/text/trimmed.hpp"
#include "medium/plain_text.hpp"
#include "medium/units.hpp"

namespace slipfront::catalogue {
namespace {

using Role = Column::Role;

constexpr std::size_t most_words = 12;  // longer titles are sentences

/// Titles with a meaning of their own, which are matched as a whole.
constexpr std::pair<std::string_view, Role> exact_titles[] = {
    {"slip_velocity_is", Role::slip_velocity_is},
    {"rupture_velocity_is", Role::rupture_velocity_is},
    {"stress_drop_is", Role::stress_drop_is},
    {"front_threshold", Role::front_threshold},
};

std::string joined(const std::vector<std::string>& words, std::size_t begin, std::size_t end) {
  std::string all;
  for (std::size_t i = begin; i < std::min(end, words.size()); ++i) all += words[i];
  return all;
}

/// The longest name of a quantity that begins at a word. `end` becomes the word behind it.
const Key* name_at(const Title& t, std::size_t begin, std::size_t& end) {
  for (end = std::min(t.small.size(), begin + 5); end > begin; --end)
    if (const Key* key = quantity_of_name(joined(t.small, begin, end))) return key;
  return nullptr;
}

bool is_largest(std::string_view word) { return word == "peak" || word == "max" || word == "maximum"; }

/// The quantity of a title, before its unit is read.
struct Named {
  const Key* key = nullptr;
  std::size_t end = 0;  ///< the first word behind the name
  bool is_error = false, is_largest = false, is_static = false;
  bool is_apparent = false;
  double deviations = 1;
};

Named find_name(const Title& t) {
  Named n;
  std::size_t begin = 0;
  if (!t.small.empty() && deviations_of(t.small[0]) > 0 && t.small.size() > 1) {
    n.is_error = true;
    n.deviations = deviations_of(t.small[0]);
    begin = t.small[1] == "of" || t.small[1] == "in" ? 2 : 1;
  }
  for (; begin < t.small.size(); ++begin) {
    n.key = name_at(t, begin, n.end);
    if (n.key) break;
    const std::string& word = t.small[begin];
    if (is_largest(word))
      n.is_largest = true;
    else if (word == "static")
      n.is_static = true;
    else if (word == "apparent")
      n.is_apparent = true;
    else if (!is_neutral(word))
      break;
  }
  if (!n.key && t.words.size() >= 2 && t.words[0] == "friction" && t.words[1] == "coefficient") {
    n.key = find_key("friction_coefficient");
    n.end = 2;
  }
  const bool may_be_largest = n.key && (n.key->name == "slip" || n.key->name == "slip_velocity");
  const bool may_be_static = n.key && n.key->name == "stress_drop";
  const bool may_be_apparent = n.key && n.key->name == "rupture_velocity";
  if ((n.is_largest && !may_be_largest) || (n.is_static && !may_be_static) || (n.is_apparent && !may_be_apparent))
    n.key = nullptr;
  return n;
}

/// Takes a word about an error: "err", "sd", "plus", "upper", ... Returns whether it was one.
bool take_error_word(const std::string& word, Column& column) {
  const auto is_one_of = [&](std::initializer_list<std::string_view> words) {
    return std::find(words.begin(), words.end(), word) != words.end();
  };
  if (deviations_of(word) > 0) {
    if (!column.is_error()) column.role = Role::error;
    column.deviations = deviations_of(word);
  } else if (is_one_of({"plus", "+"}) || (column.is_error() && is_one_of({"upper", "up", "pos"}))) {
    column.role = Role::error_above;
  } else if (is_one_of({"minus", "-"}) || (column.is_error() && is_one_of({"lower", "low", "neg"}))) {
    column.role = Role::error_below;
  } else {
    return false;
  }
  return true;
}

/// Reads the words behind the name of a quantity. Returns the others, which may be the unit.
std::vector<std::string> read_suffix(const Title& t, const Named& n, Column& column) {
  std::vector<std::string> others;
  for (std::size_t at = n.end; at < t.small.size(); ++at) {
    const std::string& word = t.small[at];
    const bool low = word == "min" || word == "minimum", high = word == "max" || word == "maximum";
    if (take_error_word(word, column)) continue;
    if ((low || high) && others.empty() && column.role == Role::quantity && column.key->measured)
      column.role = low ? Role::range_low : Role::range_high;
    else if (word != "in" && word != "of")
      others.push_back(t.words[at]);
  }
  return others;
}

/// A short text in parentheses that is a symbol rather than a unit, as in "Slip (D)".
bool is_symbol(std::string_view group) { return group.size() <= 2; }

/// Removes the power of ten from "x 10^18 N m" or "1e18 N m", and stores it.
std::string without_power(const std::string& group, int& exponent) {
  std::string text = medium::plain_number(group);
  if (text.starts_with('x')) text = trimmed(std::string_view(text).substr(1));
  const std::size_t digits = text.starts_with("10^") ? 3 : text.starts_with("1e") ? 2 : 0;
  const auto blank = text.find(' ');
  if (digits == 0 || blank == std::string::npos) return group;
  const auto power = medium::number(std::string_view(text).substr(digits, blank - digits));
  if (!power || *power != std::floor(*power) || std::fabs(*power) > 40) return group;
  exponent = static_cast<int>(*power);
  return text.substr(blank + 1);
}

/// The unit among the texts in parentheses, or in the words behind the name. Returns false if neither is understood.
bool read_unit(const Title& t, const std::vector<std::string>& words, Column& column) {
  for (const std::string& group : t.groups) {
    if (group == "%" && column.is_error()) {
      column.in_percent = true;
    } else if (const double deviations = deviations_of(joined(divide_title(group).small, 0, 3)); deviations > 0) {
      if (!column.is_error()) column.role = Role::error;
      column.deviations = deviations;
    } else if (const std::string unit = medium::plain_unit(without_power(group, column.exponent));
               medium::parse_unit(unit)) {
      column.unit = unit;
    } else if (!is_symbol(group)) {
      return false;
    }
  }
  if (words.empty()) return true;
  const bool symbols = std::all_of(words.begin(), words.end(), [](const std::string& w) { return is_symbol(w); });
  if (!column.unit.empty()) return symbols;
  if (words.size() == 1 && (words[0] == "%" || words[0] == "percent" || words[0] == "pct") && column.is_error())
    return column.in_percent = true;
  std::string unit;
  // "km_s" is km/s, but "N_m" of a moment is N m.
  const char* between = column.key && column.key->dimension == medium::Dimension::moment ? " " : "/";
  for (const std::string& word : words) unit += (unit.empty() ? "" : between) + word;
  column.unit = medium::plain_unit(unit);
  return medium::parse_unit(column.unit).has_value();
}

void refuse_near_miss(const std::string& title, const Title& t) {
  std::string head;
  for (const std::string& word : t.small) {
    head += (head.empty() ? "" : "_") + word;
    if (head.size() < 6 || head.size() > 40) continue;
    for (const Key& key : quantity_keys())
      if (key.name.size() > 6 && edit_distance(head, key.name) <= 2)
        throw InputError({.key = title,
                          .problem = "unknown column",
                          .allowed = "'" + std::string(key.name) + "' (the nearest known name) with its unit"});
  }
}

/// Whether the words are errors, sides of errors or angles, as behind "latitude" or "magnitude".
bool is_detail(const std::vector<std::string>& words, std::size_t begin) {
  return std::all_of(words.begin() + static_cast<std::ptrdiff_t>(begin), words.end(), [](const std::string& word) {
    return deviations_of(word) > 0 || word == "deg" || word == "km" || word == "plus" || word == "minus";
  });
}

bool has_unit(const Title& t) {
  return std::any_of(t.groups.begin(), t.groups.end(), [](const std::string& group) {
    const auto unit = medium::parse_unit(medium::plain_unit(group));
    return unit && unit->powers != std::array<int, 3>{};
  });
}

/// A column without a quantity. It looks physical if it has a unit, or a word of a quantity.
Column other(const std::string& title, const Title& t) {
  Column column{.title = title};
  const bool has_prefix = !t.small.empty() && deviations_of(t.small[0]) > 0 && t.small.size() > 1;
  const std::size_t begin = has_prefix ? 1 : 0;
  for (std::size_t end = std::min(begin + 3, t.small.size()); end > begin; --end) {
    const std::string name = joined(t.small, begin, end);
    const auto role = role_of_name(name);
    if (!role || !is_detail(t.small, end)) continue;
    column.role = *role == Role::unused || (begin == 0 && end == t.small.size()) ? *role : Role::unknown;
    column.looks_physical = name == "time" && has_unit(t);
    if (column.looks_physical) column.role = Role::unknown;
    return column;
  }
  const bool is_count = t.small.size() > 1 && (t.small[0] == "n" || t.small[0] == "number" || t.small[0] == "no");
  if (is_count) return {.role = Role::unused, .title = title};
  column.looks_physical = std::any_of(t.small.begin(), t.small.end(), is_physical_word) || has_unit(t);
  return column;
}

/// A column "<quantity>_how" and the like, which describes how the quantity was found.
std::optional<Column> description(const std::string& title, const Title& t, const Named& n) {
  constexpr std::string_view about[] = {"how", "type", "source", "method", "note", "notes"};
  if (n.end + 1 != t.small.size() || !t.groups.empty()) return std::nullopt;
  if (std::find(std::begin(about), std::end(about), t.small[n.end]) == std::end(about)) return std::nullopt;
  return Column{.role = t.small[n.end] == "how" ? Role::provenance : Role::unused, .title = title, .key = n.key};
}

/// Names that mean something else in many tables, unless the unit decides.
bool is_ambiguous(const Title& t, const Column& column) {
  const std::string name = joined(t.small, 0, t.small.size());
  if (name == "mo" || name == "m0") return column.unit.empty();
  const bool is_long_term = column.unit == "mm/yr" || column.unit == "mm/year" || column.unit == "mm/a";
  return column.key->name == "slip_velocity" && name.find("rate") != std::string::npos && is_long_term;
}

void state_assumptions(const Named& n, Column& column) {
  column.is_largest = n.is_largest;
  column.is_static = n.is_static;
  if (n.is_largest && column.key->name == "slip") column.assumption = "slip is the largest on the fault";
  if (n.is_apparent) column.assumption = "rupture_velocity is apparent by its title";
}

/// "Vs (km/s)" and "Vp (km/s)" are wave speeds. With another unit, "Vs" may be a slip velocity.
void find_wave_speed(const Title& t, Named& n) {
  const bool in_km_s = t.groups.size() == 1 && medium::plain_unit(t.groups[0]) == "km/s";
  if (n.key || t.small.size() != 1 || !in_km_s) return;
  if (t.small[0] == "vs") n.key = find_key("s_wave_speed");
  if (t.small[0] == "vp") n.key = find_key("p_wave_speed");
  n.end = 1;
}

Column without_name(const std::string& title, const Title& t) {
  const bool is_mw =
      t.small.back() == "magnitude" && t.groups.size() == 1 && (t.groups[0] == "Mw" || t.groups[0] == "MW");
  if (is_mw) return {.role = Role::quantity, .title = title, .key = find_key("moment_magnitude")};
  Column column = other(title, t);
  if (column.role == Role::unknown) refuse_near_miss(title, t);
  return column;
}

void refuse_wrong_unit(const Column& column) {
  if (column.unit.empty()) return;
  try {
    medium::unit_factor(column.unit, column.key->dimension);
  } catch (const InputError& error) {
    throw InputError({.key = column.title,
                      .problem = error.complaint().problem,
                      .allowed = std::string(medium::example(column.key->dimension))});
  }
}

}  // namespace

Column parse_column(const std::string& title) {
  for (const auto& [word, role] : exact_titles)
    if (title == word) return {.role = role, .title = title};
  const Title t = divide_title(title);
  if (t.words.empty() || t.words.size() > most_words) return {.title = title};
  if (const auto role = role_of_name(joined(t.small, 0, t.small.size())))
    if (*role != Role::unused && t.groups.empty()) return {.role = *role, .title = title};
  Named n = find_name(t);
  find_wave_speed(t, n);
  if (!n.key) return without_name(title, t);
  if (auto about = description(title, t, n)) return *about;
  Column column{.role = n.is_error ? Role::error : Role::quantity, .title = title, .key = n.key};
  column.deviations = n.deviations;
  const std::vector<std::string> others = read_suffix(t, n, column);
  if (!read_unit(t, others, column) || is_ambiguous(t, column)) {
    Column unknown{.title = title};
    unknown.looks_physical = true;
    return unknown;
  }
  refuse_wrong_unit(column);
  state_assumptions(n, column);
  return column;
}

}  // namespace slipfront::catalogue
