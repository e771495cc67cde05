#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>

#include "events/catalogue/csv/csv.hpp"
#include "events/catalogue/keys.hpp"
#include "math/digits.hpp"
#include "text/characters.hpp"
#include "text/units.hpp"

namespace slipfront::catalogue {
namespace {

using Role = Column::Role;

/// Replaces the decimal comma of a number by a point.
std::string with_point(const std::string& cell, bool decimal_comma) {
  std::string text = cell;
  bool any = false;
  for (std::size_t i = 1; i + 1 < text.size(); ++i) {
    if (text[i] != ',' || !is_digit(text[i - 1]) || !is_digit(text[i + 1])) continue;
    any = true;
    if (decimal_comma) text[i] = '.';
  }
  if (!any || (!decimal_comma && cell.find('(') != std::string::npos)) return text;
  if (!decimal_comma)
    throw InputError({.value = cell,
                      .problem = "a comma inside a number",
                      .allowed = "a decimal point, or the line '# decimal: ,' before the header"});
  if (cell.find('.') != std::string::npos && cell.find("..") == std::string::npos)
    throw InputError({.value = cell, .problem = "a point and a decimal comma", .allowed = "decimal commas only"});
  return text;
}

/// A time in days since 1970, and the days to which its text gives it.
struct Day {
  double at, resolution;
};

/// Reads a year with decimals, "2014.39", or a date of ISO 8601, "2014-05-23" or "2014-05-23T10:30".
std::optional<Day> parse_day(std::string_view text) {
  using namespace std::chrono;
  const auto day_of = [](int y, unsigned m, unsigned d) {
    return static_cast<double>(sys_days(year(y) / month(m) / day(d)).time_since_epoch().count());
  };
  text = trimmed(text);
  if (const auto number = medium::number(text);
      number && text.size() > 5 && text.size() < 20 && text[4] == '.' && is_digit(text[0])) {
    const int y = static_cast<int>(*number);
    const double begin = day_of(y, 1, 1), length = day_of(y + 1, 1, 1) - begin;
    return Day{begin + (*number - y) * length, length * std::pow(10.0, 5.0 - static_cast<double>(text.size()))};
  }
  int y = 0, m = 0, d = 0, hour = 0, minute = 0, used = 0;
  const std::string date(text);
  if (std::sscanf(date.c_str(), "%4d-%2d-%2d%n", &y, &m, &d, &used) != 3 &&
      std::sscanf(date.c_str(), "%4d/%2d/%2d%n", &y, &m, &d, &used) != 3)
    return std::nullopt;
  const bool has_time = std::sscanf(date.c_str() + used, "%*1[T ]%2d:%2d", &hour, &minute) == 2;
  if (!(year(y) / m / d).ok() || (used < static_cast<int>(date.size()) && !has_time)) return std::nullopt;
  return Day{day_of(y, static_cast<unsigned>(m), static_cast<unsigned>(d)) + (hour + minute / 60.0) / 24,
             has_time ? 0.0 : 1.0};
}

/// Reads the cells of a row into an observation.
class Row {
 public:
  Row(Observation& o, const Layout& layout) : o_(o), layout_(layout) {}

  void take(const Column& column, const std::string& cell);
  void finish();

 private:
  /// The ends of a range and the errors of one quantity, from the columns next to its value.
  struct Further {
    const Column* column;  ///< the first of them
    std::map<Role, double> numbers = {};
    bool in_percent = false;
  };

  void take_further(const Column& column, const std::string& text);
  void use(const Further& further);
  void find_duration();

  Observation& o_;
  const Layout& layout_;
  std::vector<Further> further_;
  std::map<std::string_view, std::string> texts_;
  bool is_peak_ = false;
};

/// Reads an end of a range, or an error.
void Row::take_further(const Column& column, const std::string& cell) {
  const auto at =
      std::find_if(further_.begin(), further_.end(), [&](const Further& f) { return f.column->key == column.key; });
  Further& further = at != further_.end() ? *at : further_.emplace_back(Further{&column});
  double& number = further.numbers[column.role];
  if (column.is_quantity()) {
    Observation end;
    store(end, *column.key, cell, column.unit);
    const auto value = value_of(end, *column.key);
    if (!value) throw InputError({.value = cell, .problem = "not a number", .allowed = "a number"});
    number = column.role == Role::low ? value->low : value->high;
    return;
  }
  std::string unit = column.unit, text = medium::plain_number(cell);
  for (const Column& main : layout_.columns)
    if (unit.empty() && main.key == column.key && main.role == Role::value) unit = main.unit;
  const bool has_percent = text.ends_with('%');
  if (has_percent) text.pop_back();
  further.in_percent = further.in_percent || has_percent || column.in_percent;
  const MeasuredValue error = further.in_percent ? parse_measured(text, medium::Dimension::ratio, "")
                                                 : parse_measured(text, column.key->dimension, unit);
  if (!error.is_exact()) throw InputError({.value = cell, .problem = "not one number", .allowed = "an error > 0"});
  number = error.low / column.deviations * (further.in_percent ? 0.01 : 1);
  if (column.role == Role::error_below) number = std::fabs(number);
  if (number < 0) throw InputError({.value = cell, .problem = "the error is negative", .allowed = "> 0"});
}

/// Reads a cell; what is wrong with it gets the column's title.
void Row::take(const Column& column, const std::string& cell) {
  try {
    const bool has_numbers = column.is_quantity() || column.is_error();
    const std::string text = has_numbers ? with_point(cell, layout_.decimal_comma) : cell;
    const bool lacks_unit = has_numbers && column.unit.empty() && column.key->dimension != medium::Dimension::ratio;
    if (column.role == Role::value && lacks_unit && is_auxiliary(*column.key) && medium::number(text)) {
      o_.warnings.push_back("column '" + column.title + "' has no unit: not used");
    } else if (column.role == Role::value) {
      store(o_, *column.key, text, column.unit);
      if (!column.assumption.empty()) o_.warnings.push_back(column.assumption);
      if (column.is_largest && column.key->name == "slip_velocity") is_peak_ = true;
      if (column.is_static) o_.stress_drop_is = StressDropIs::static_drop;
    } else if (has_numbers) {
      take_further(column, text);
    } else if (column.role == Role::how) {
      if (cell.find("computed") != std::string::npos || cell.find("apparent") != std::string::npos)
        o_.warnings.push_back(std::string(column.key->name) + ": " + cell);
    } else if (texts_.emplace(column.text, cell).second) {
      store_text(o_, column.text, cell);
    }
  } catch (const InputError& error) {
    Complaint c = error.complaint();
    c.key = column.title;
    throw InputError(c);
  }
}

/// Gives a quantity its range, if the row does not give the quantity itself, or its error.
void Row::use(const Further& further) {
  const Key& key = *further.column->key;
  const std::string name(key.name);
  const auto number = [&](Role role) {
    const auto at = further.numbers.find(role);
    return at == further.numbers.end() ? std::nullopt : std::optional(at->second);
  };
  const auto refuse = [&](const char* problem, const char* allowed) {
    throw InputError({.key = further.column->title, .problem = problem, .allowed = allowed});
  };
  const auto low = number(Role::low), high = number(Role::high);
  if ((low || high) && !value_of(o_, key)) {
    if (low && high && *low > *high) refuse("the range runs downwards", "min <= max");
    if (low && high)
      o_.*key.measured = MeasuredValue{*low, *high};
    else
      o_.warnings.push_back("only one end of the range of " + name + " is known: not used");
  }
  const auto error = number(Role::error), above = number(Role::error_above), below = number(Role::error_below);
  const auto value = value_of(o_, key);
  if ((!error && !above && !below) || !value) return;
  if (!value->is_exact()) refuse("the value has an error of its own", "one error for each value");
  if (error && (above || below)) refuse("two kinds of error", "one error for each value");
  if (!error && (!above || !below)) {
    o_.warnings.push_back("only one of the two errors of " + name + " is known: not used");
    return;
  }
  const double unit = further.in_percent ? std::fabs(value->low) : 1;
  const double up = unit * (error ? *error : *above), down = unit * (error ? *error : *below);
  if (up == 0 && down == 0) {
    o_.warnings.push_back("the error of " + name + " is 0: the value is taken as exact");
    return;
  }
  if (up == 0 || down == 0) refuse("one of the two errors is 0", "one error for each value");
  store(o_, key, split(value->low, up, down), name);
}

/// The duration from the start to the end, if the row gives no other.
void Row::find_duration() {
  const std::string &start = texts_["start"], &end = texts_["end"];
  if (start.empty() || end.empty() || o_.duration) return;
  const auto first = parse_day(start), last = parse_day(end);
  if (!first || !last || !(last->at > first->at)) {
    o_.warnings.push_back("duration: '" + start + "' to '" + end +
                          "' are not two dates, the first before the second, such as 2014.39 or 2014-05-23: not used");
    return;
  }
  const double days = last->at - first->at, resolution = std::max(first->resolution, last->resolution);
  o_.duration = MeasuredValue{days * 86400, days * 86400};
  o_.warnings.push_back("duration is end - start, " + digits(days, 3) + " days" +
                        (resolution > 0 ? "; the dates are given to " + digits(resolution, 2) + " days" : ""));
}

void Row::finish() {
  for (const Further& further : further_) use(further);
  find_duration();
  derive_stress_drop(o_);
  if (is_peak_ && !o_.slip_velocity_is) o_.slip_velocity_is = SlipVelocityKind::peak;
  if (o_.name.empty()) o_.name = texts_["identifier"];
  if (o_.date.empty()) o_.date = texts_["start"];
  const std::string year = texts_["year"], month = texts_["month"], day = texts_["day"];
  if (!o_.date.empty() || year.empty()) return;
  const auto two = [](const std::string& text) { return (text.size() == 1 ? "-0" : "-") + text; };
  o_.date = year + (month.empty() ? "" : two(month)) + (month.empty() || day.empty() ? "" : two(day));
}

}  // namespace

Entry read_row(const Layout& layout, const ColumnMap& map, const TableOptions& options,
               const std::vector<std::string>& cells, std::size_t line, const std::string& file) {
  const std::vector<Column>& columns = layout.columns;
  Entry entry;
  Observation& o = entry.observation;
  o.file = file;
  o.line = line;
  Row row(o, layout);
  try {
    const std::size_t both = std::min(columns.size(), cells.size());
    for (std::size_t i = 0; i < both; ++i)
      if (columns[i].text == "name" && o.name.empty()) o.name = cells[i];
    const bool more = std::any_of(cells.begin() + static_cast<std::ptrdiff_t>(both), cells.end(),
                                  [](const std::string& cell) { return !trimmed(cell).empty(); });
    if (cells.size() < columns.size() || more)
      throw InputError(
          {.problem = "the row has " + std::to_string(cells.size()) + (cells.size() == 1 ? " cell" : " cells"),
           .allowed = std::to_string(columns.size()) + " cells, as in the header"});
    const auto is_required = [&](const Column& c) {
      const auto& all = options.required;
      return c.role == Role::value && std::find(all.begin(), all.end(), c.key->name) != all.end();
    };
    for (std::size_t i = 0; i < columns.size(); ++i)
      if (columns[i].is_used() && !is_absent(cells[i], map.missing))
        row.take(columns[i], cells[i]);
      else if (is_required(columns[i]))
        throw InputError({.key = columns[i].title,
                          .value = cells[i],
                          .problem = "no value",
                          .allowed = std::string(medium::example(columns[i].key->dimension))});
    row.finish();
  } catch (const InputError& error) {
    entry.error = error.complaint();
    entry.error->file = file;
    entry.error->line = line;
  }
  if (o.name.empty()) o.name = "line " + std::to_string(line);
  return entry;
}

}  // namespace slipfront::catalogue
