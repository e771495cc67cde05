#include <algorithm>
#include <array>
#include <cmath>

#include "events/catalogue/csv/csv.hpp"
#include "text/characters.hpp"
#include "text/units.hpp"

namespace slipfront::catalogue {
namespace {

using Role = Column::Role;

constexpr std::size_t most_words = 12;  // longer titles are sentences

/// A header cell, divided into its words and its texts in parentheses or brackets.
struct Title {
  std::vector<std::string> words;   ///< as written; they were separated by blanks or '_'
  std::vector<std::string> small;   ///< the words in small letters, without '-' and a final '.'
  std::vector<std::string> groups;  ///< texts in ( ) or [ ], and one behind a comma

  /// The words from `begin` to `end` without blanks between them.
  std::string joined(std::size_t begin = 0, std::size_t end = most_words) const {
    std::string all;
    for (std::size_t i = begin; i < std::min(end, small.size()); ++i) all += small[i];
    return all;
  }
};

std::string small_word(std::string_view word) {
  std::string small = small_letters(word);
  if (small.find_first_not_of("+-/") == std::string::npos) return small;
  if (small.size() > 1 && (small.back() == '.' || small.back() == ':')) small.pop_back();
  if (small.find('/') == std::string::npos && small.find_first_of("0123456789") == std::string::npos)
    small.erase(std::remove(small.begin(), small.end(), '-'), small.end());
  return small;
}

Title divide_title(std::string_view title) {
  Title out;
  std::string text(trimmed(title));
  for (auto open = text.find_first_of("[("); open != std::string::npos; open = text.find_first_of("[(", open)) {
    const auto close = text.find(text[open] == '[' ? ']' : ')', open);
    if (close == std::string::npos) break;
    out.groups.emplace_back(trimmed(std::string_view(text).substr(open + 1, close - open - 1)));
    text.replace(open, close + 1 - open, close + 1 - open, ' ');
  }
  if (const auto comma = text.find_last_of(','); comma != std::string::npos) {
    out.groups.emplace_back(trimmed(std::string_view(text).substr(comma + 1)));
    text.erase(comma);
  }
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find_first_of(" _\t\n\r", at), text.size());
    if (end > at) {
      out.words.push_back(text.substr(at, end - at));
      out.small.push_back(small_word(out.words.back()));
    }
    at = end + 1;
  }
  return out;
}

bool is(std::string_view word, Word kind) { return !meaning_of(word, kind).empty(); }

/// The number of standard deviations that a word for an error stands for; 0 for other words.
double deviations_of(std::string_view word) {
  const std::string_view meaning = meaning_of(word, Word::error);
  return meaning.empty() ? 0 : meaning == "1" ? 1 : 2;
}

/// The powers of the unit, if the text is one.
std::optional<std::array<int, 3>> powers_of(const std::string& text) {
  const auto unit = medium::parse_unit(medium::plain_unit(text));
  return unit ? std::optional(unit->powers) : std::nullopt;
}

bool has_unit(const Title& t) {
  return std::any_of(t.groups.begin(), t.groups.end(), [](const std::string& group) {
    return powers_of(group).value_or(std::array<int, 3>{}) != std::array<int, 3>{};
  });
}

Column not_understood(const std::string& title, const char* reason) {
  Column column{.title = title};
  column.looks_physical = true;
  column.reason = reason;
  return column;
}

/// The longest name of a quantity that begins at a word. `end` becomes the word behind it.
const Key* name_at(const Title& t, std::size_t begin, std::size_t& end, const std::vector<Key>& keys) {
  for (end = std::min(t.small.size(), begin + 5); end > begin; --end)
    if (const auto name = meaning_of(t.joined(begin, end), Word::quantity); !name.empty()) return find_key(name, keys);
  return nullptr;
}

/// Finds the quantity of a title, and what the words before it state. Returns the first word behind the name.
std::size_t find_name(const Title& t, const std::vector<Key>& keys, Column& column) {
  std::size_t begin = 0, end = 0;
  std::string_view qualifier;
  column.role = Role::value;
  if (t.small.size() > 1 && deviations_of(t.small[0]) > 0 && !name_at(t, 0, end, keys)) {
    column.role = Role::error;
    column.deviations = deviations_of(t.small[0]);
    begin = t.small[1] == "of" || t.small[1] == "in" ? 2 : 1;
  }
  for (; begin < t.small.size() && !(column.key = name_at(t, begin, end, keys)); ++begin) {
    if (const auto meaning = meaning_of(t.small[begin], Word::prefix); !meaning.empty())
      qualifier = meaning;
    else if (!is(t.small[begin], Word::neutral))
      break;
  }
  // In publications a friction coefficient is not C, so only the exact title counts.
  if (column.key && column.key->name == "friction_coefficient" && t.words[0] != "friction") column.key = nullptr;
  if (!column.key || qualifier.empty()) return end;
  const std::string_view name = column.key->name;
  column.is_largest = qualifier == "largest" && (name == "slip" || name == "slip_velocity");
  column.is_static = qualifier == "static" && name == "stress_drop";
  if (column.is_largest && name == "slip") column.assumption = "slip is the largest on the fault";
  if (qualifier == "apparent" && name == "rupture_velocity")
    column.assumption = "rupture_velocity is apparent by its title";
  if (!column.is_largest && !column.is_static && column.assumption.empty()) column.key = nullptr;
  return end;
}

/// Reads the words behind the name of a quantity, such as "err", "plus" or "max". Returns the others, which may be the
/// unit.
std::vector<std::string> read_suffix(const Title& t, std::size_t begin, Column& column) {
  std::vector<std::string> others;
  for (std::size_t at = begin; at < t.small.size(); ++at) {
    const std::string& word = t.small[at];
    const auto range = meaning_of(word, Word::range), above = meaning_of(word, Word::above),
               below = meaning_of(word, Word::below);
    const bool is_error = column.is_error();
    if (const double deviations = deviations_of(word); deviations > 0) {
      if (!is_error) column.role = Role::error;
      column.deviations = deviations;
    } else if (above == "always" || (is_error && !above.empty())) {
      column.role = Role::error_above;
    } else if (below == "always" || (is_error && !below.empty())) {
      column.role = Role::error_below;
    } else if (!range.empty() && others.empty() && column.role == Role::value && column.key->measured) {
      column.role = range == "low" ? Role::low : Role::high;
    } else if (word != "in" && word != "of") {
      others.push_back(t.words[at]);
    }
  }
  return others;
}

/// A short text in parentheses that is a symbol rather than a unit, as in "Slip (D)".
bool is_symbol(std::string_view group) { return group.size() <= 2; }

/// The unit in parentheses. It may have a power of ten, as in "x 10^18 N m". Empty if the text is none.
std::string unit_in(const std::string& group) {
  const std::string text = medium::plain_number(group);
  const bool has_power = text.find("10^") != std::string::npos || text.starts_with("1e");
  const std::string unit = has_power ? medium::plain_column_unit(group) : medium::plain_unit(group);
  return powers_of(has_power ? unit.substr(unit.find(' ') + 1) : unit) ? unit : "";
}

/// The unit among the texts in parentheses, or in the words behind the name. Returns false if neither is understood.
bool read_unit(const Title& t, const std::vector<std::string>& words, Column& column) {
  for (const std::string& group : t.groups) {
    if (group == "%" && column.is_error()) {
      column.in_percent = true;
    } else if (const double deviations = deviations_of(divide_title(group).joined(0, 3)); deviations > 0) {
      if (!column.is_error()) column.role = Role::error;
      column.deviations = deviations;
    } else if (const std::string unit = unit_in(group); !unit.empty()) {
      column.unit = unit;
    } else if (!is_symbol(group)) {
      return false;
    }
  }
  if (words.empty()) return true;
  if (!column.unit.empty()) return std::all_of(words.begin(), words.end(), is_symbol);
  if (words.size() == 1 && (words[0] == "%" || words[0] == "percent" || words[0] == "pct") && column.is_error())
    return column.in_percent = true;
  // "km_s" is km/s, but "N_m" of a moment is N m.
  const char* between = column.key->dimension == medium::Dimension::moment ? " " : "/";
  for (const std::string& word : words) column.unit += (column.unit.empty() ? "" : between) + word;
  column.unit = medium::plain_unit(column.unit);
  return powers_of(column.unit).has_value();
}

/// Names that mean something else in many tables, unless the unit decides.
bool is_ambiguous(const Title& t, const Column& column) {
  const std::string name = t.joined();
  if (name == "mo" || name == "m0") return column.unit.empty();
  const auto has = [&](const char* part) { return name.find(part) != std::string::npos; };
  const bool is_wave = column.key->name == "s_wave_speed" || column.key->name == "p_wave_speed";
  if (is_wave && (has("vs") || has("vp")) && !has("hypocent")) return column.unit != "km/s";  // Vs may be of slip
  const bool is_long_term = column.unit == "mm/yr" || column.unit == "mm/year" || column.unit == "mm/a";
  return column.key->name == "slip_velocity" && has("rate") && is_long_term;
}

/// The complaint about a title that nearly names a quantity.
std::optional<Complaint> near_miss(const std::string& title, const Title& t, const std::vector<Key>& keys) {
  std::string head;
  for (const std::string& word : t.small) {
    head += (head.empty() ? "" : "_") + word;
    if (head.size() < 6 || head.size() > 40) continue;
    for (const Key& key : keys)
      if (key.name.size() > 6 && edit_distance(head, key.name) <= 2)
        return Complaint{.key = title,
                         .problem = "unknown column",
                         .allowed = "'" + std::string(key.name) + "' (the nearest known name) with its unit"};
  }
  return std::nullopt;
}

/// Whether the words are errors, sides of errors or angles, as behind "latitude" or "magnitude".
bool is_detail(const Title& t, std::size_t begin) {
  return std::all_of(t.small.begin() + static_cast<std::ptrdiff_t>(begin), t.small.end(), [](const std::string& word) {
    return is(word, Word::error) || word == "deg" || word == "km" || word == "plus" || word == "minus";
  });
}

/// A column without a quantity. It looks physical if it has a unit, or a word of a quantity.
Column column_without_quantity(const std::string& title, const Title& t, const std::vector<Key>& keys) {
  if (t.small.back() == "magnitude" && t.groups.size() == 1 && (t.groups[0] == "Mw" || t.groups[0] == "MW"))
    if (const Key* magnitude = find_key("moment_magnitude", keys))
      return {.role = Role::value, .title = title, .key = magnitude};
  Column unused{.role = Role::unused, .title = title};
  unused.reason = "slipfront does not need it";
  const std::size_t begin = t.small.size() > 1 && is(t.small[0], Word::error) ? 1 : 0;
  for (std::size_t end = std::min(begin + 3, t.small.size()); end > begin; --end) {
    const std::string name = t.joined(begin, end);
    const std::string_view text = meaning_of(name, Word::text);
    if ((text.empty() && !is(name, Word::unused)) || !is_detail(t, end)) continue;
    const bool is_end = text == "start" || text == "end";
    if (has_unit(t) && (name == "time" || (is_end && powers_of(t.groups[0]) != std::array{0, 0, 1}))) break;
    if (text.empty()) return unused;
    return begin > 0 || end < t.small.size() ? Column{.title = title}
                                             : Column{.role = Role::text, .title = title, .text = text};
  }
  if (t.small.size() > 1 && (t.small[0] == "n" || t.small[0] == "number" || t.small[0] == "no")) return unused;
  Column column{.title = title};
  column.looks_physical = has_unit(t) || std::any_of(t.small.begin(), t.small.end(),
                                                     [](const std::string& word) { return is(word, Word::physical); });
  column.refusal = near_miss(title, t, keys);
  return column;
}

Column whole_title(const std::string& title, const std::vector<Key>& keys) {
  const Title t = divide_title(title);
  if (t.words.empty() || t.words.size() > most_words) return {.title = title};
  if (const auto text = meaning_of(t.joined(), Word::text); !text.empty() && t.groups.empty())
    return {.role = Role::text, .title = title, .text = text};
  Column column{.title = title};
  const std::size_t end = find_name(t, keys, column);
  if (!column.key) return column_without_quantity(title, t, keys);
  if (end + 1 == t.small.size() && t.groups.empty() && is(t.small[end], Word::about)) {
    const bool is_how = meaning_of(t.small[end], Word::about) == "how";
    return {.role = is_how ? Role::how : Role::unused, .title = title, .key = column.key};
  }
  const std::vector<std::string> others = read_suffix(t, end, column);
  if (!read_unit(t, others, column)) return not_understood(title, "the unit is not understood");
  if (is_ambiguous(t, column)) return not_understood(title, "the name has several meanings");
  if (!column.unit.empty()) try {
      medium::column_unit_factor(column.unit, column.key->dimension);
    } catch (const InputError& error) {
      column.refusal = {.key = title,
                        .problem = error.complaint().problem,
                        .allowed = std::string(medium::example(column.key->dimension))};
    }
  return column;
}

/// A bare error belongs to the last quantity before it; so do both of a pair "+", "-". In "err (Vr)" the parentheses
/// name the quantity. If their text is neither a quantity nor a unit of the quantity before, the column is unknown.
Column bare_error(const std::string& title, const Title& t, const std::vector<Column>& before,
                  const std::vector<Key>& keys) {
  Column none = not_understood(title, "an error without its quantity");
  std::string name;
  for (const std::string& group : t.groups)
    if (const Column inside = whole_title(group, keys); inside.role == Role::value)
      name = std::string(inside.key->name) + " " + t.small[0];
  if (name.empty() && !before.empty()) {
    if (before.back().role == Role::unused) return {.role = Role::unused, .title = title};
    if (before.back().key && before.back().role != Role::how) name = std::string(before.back().key->name) + " " + title;
  }
  if (name.empty()) return none;
  Column column = whole_title(name, keys);
  column.title = title;
  return column.is_error() && !column.refusal ? column : none;  // the unit may be that of something else
}

/// Makes a column one that is not used; `looks_physical` if its numbers are lost.
void drop(Column& column, bool looks_physical, std::string reason) {
  column = {.role = looks_physical ? Role::unknown : Role::unused, .title = column.title};
  column.looks_physical = looks_physical;
  column.reason = std::move(reason);
}

/// Decides between two columns of the same number. The mean counts if the other column is the largest value. The first
/// of two auxiliary columns counts.
void settle(Column& first, Column& second) {
  if (first.title == second.title)
    second.refusal = {.key = second.title, .problem = "column given twice", .allowed = "each column once"};
  else if (first.is_largest != second.is_largest)
    drop(first.is_largest ? first : second, false, "another column has the mean");
  else if (is_auxiliary(*second.key))
    drop(second, true, "'" + first.title + "' is used");
  else
    second.refusal = {
        .key = second.title,
        .problem = "a second column of " + std::string(second.key->name) + " besides '" + first.title + "'",
        .allowed = "one; --columns map.toml can ignore the other"};
}

/// A title such as "Vr +- 1 sd (km/s)" names the value too, unless another column does. Other errors without a value
/// are not understood.
void settle_error(Column& error, const std::vector<Column>& columns) {
  if (std::any_of(columns.begin(), columns.end(),
                  [&](const Column& c) { return c.is_quantity() && c.key == error.key; }))
    return;
  const Title t = divide_title(error.title);
  if (t.small.size() > 1 && std::any_of(t.small.begin() + 1, t.small.end(), [](const std::string& word) {
        return word == "+-" || word == "+/-" || word == "\xC2\xB1";
      }))
    error.role = Role::value;
  else
    drop(error, true, "no column has the value of this error");
}

}  // namespace

bool is_auxiliary(const Key& key) {
  for (const char* name : {"moment", "moment_magnitude", "rupture_length", "rupture_width", "rupture_area"})
    if (key.name == name) return true;
  return false;
}

Column title_column(const std::string& title, const std::vector<Column>& before, const std::vector<Key>& keys) {
  const Title t = divide_title(title);
  const bool is_bare = t.small.size() == 1 && (is(t.small[0], Word::error) || t.small[0] == "+" || t.small[0] == "-");
  return is_bare ? bare_error(title, t, before, keys) : whole_title(title, keys);
}

void settle_columns(std::vector<Column>& columns) {
  for (Column& column : columns)
    if (column.is_error()) settle_error(column, columns);
  const auto has = [&](std::string_view text) {
    return std::any_of(columns.begin(), columns.end(), [&](const Column& c) { return c.text == text; });
  };
  const bool has_both = has("start") && has("end");
  for (Column& column : columns) {
    if (column.text == "start" && !has_both) column.text = "date";
    if (column.text == "end" && !has_both) drop(column, false, "no column has the start of the event");
  }
  for (std::size_t i = 0; i < columns.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (columns[i].key && columns[i].key == columns[j].key && columns[i].role == columns[j].role &&
          (columns[i].is_quantity() || columns[i].is_error()))
        settle(columns[j], columns[i]);
}

}  // namespace slipfront::catalogue
