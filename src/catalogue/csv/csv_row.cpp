#include "catalogue/csv/csv_row.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "foundation/text/characters.hpp"
#include "foundation/text/trimmed.hpp"
#include "medium/plain_text.hpp"

namespace slipfront::catalogue {
namespace {

using Role = Column::Role;

/// The ends of a range and the errors of one quantity, from the columns next to its value.
struct FurtherCells {
  const Column* column;  ///< the first of them
  std::optional<Measured> low, high;
  std::optional<double> error, above, below;
  bool in_percent = false;
};

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

/// Whether neither the title nor the cell gives a unit that the quantity needs.
bool lacks_unit(const Column& column, const std::string& text) {
  return column.unit.empty() && column.key->dimension != medium::Dimension::ratio && medium::number(text);
}

class Row {
 public:
  Row(Observation& o, const Layout& layout) : o_(o), layout_(layout) {}

  void take(const Column& column, const std::string& cell);
  void finish();

 private:
  void take_text(const Column& column, const std::string& cell);
  void take_number(const Column& column, const std::string& cell);
  void take_error(const Column& column, const std::string& cell);
  FurtherCells& further(const Column& column);
  void close_range(const FurtherCells& b);
  void add_error(const FurtherCells& b);
  std::optional<Measured> value_of(const Key& key) const;
  std::string number_text(const Column& column, const std::string& cell) const;

  Observation& o_;
  const Layout& layout_;
  std::vector<FurtherCells> further_;
  std::string identifier_, year_, month_, day_;
  bool is_peak_ = false;
};

FurtherCells& Row::further(const Column& column) {
  const auto same = std::find_if(further_.begin(), further_.end(),
                                 [&](const FurtherCells& b) { return b.column->key == column.key; });
  if (same != further_.end()) return *same;
  return *further_.insert(further_.end(), FurtherCells{&column, {}, {}, {}, {}, {}});
}

/// The text of a number in the unit of its column, with a point and with the column's power of ten.
std::string Row::number_text(const Column& column, const std::string& cell) const {
  std::string text = with_point(cell, layout_.decimal_comma);
  if (column.exponent == 0) return text;
  text = medium::plain_number(text);
  if (!medium::number(text) || text.find_first_of("eE") != std::string::npos)
    throw InputError(
        {.value = cell, .problem = "not a number", .allowed = "a number, as the title has a power of ten"});
  return text + "e" + std::to_string(column.exponent);
}

void Row::take_number(const Column& column, const std::string& cell) {
  const std::string text = number_text(column, cell);
  if (column.role == Role::quantity) {
    if (is_auxiliary(*column.key) && lacks_unit(column, text)) {
      o_.warnings.push_back("column '" + column.title + "' has no unit: not used");
      return;
    }
    store(o_, *column.key, text, column.unit);
    if (!column.assumption.empty()) o_.warnings.push_back(column.assumption);
    if (column.is_largest && column.key->name == "slip_velocity") is_peak_ = true;
    if (column.is_static) o_.stress_drop_is = StressDropIs::static_drop;
    return;
  }
  Observation end;
  store(end, *column.key, text, column.unit);
  if (!end.bounds.empty()) throw InputError({.value = cell, .problem = "not a number", .allowed = "a number"});
  (column.role == Role::range_low ? further(column).low : further(column).high) = end.*column.key->measured;
}

void Row::take_error(const Column& column, const std::string& cell) {
  FurtherCells& b = further(column);
  std::string unit = column.unit;
  for (const Column& main : layout_.columns)
    if (unit.empty() && main.key == column.key && main.role == Role::quantity) unit = main.unit;
  double error = 0;
  std::string text = medium::plain_number(number_text(column, cell));
  if (text.ends_with('%')) text.pop_back(), b.in_percent = true;
  if (column.in_percent) b.in_percent = true;
  if (b.in_percent) {
    const auto percent = medium::number(text);
    if (!percent) throw InputError({.value = cell, .problem = "not a number", .allowed = "a percentage"});
    error = *percent / 100;
  } else {
    const Measured m = parse_measured(text, column.key->dimension, unit);
    if (!m.is_exact()) throw InputError({.value = cell, .problem = "not one number", .allowed = "an error > 0"});
    error = m.low;
  }
  if (column.role == Role::error_below) error = std::fabs(error);
  if (error < 0) throw InputError({.value = cell, .problem = "the error is negative", .allowed = "> 0"});
  error /= column.deviations;
  (column.role == Role::error ? b.error : column.role == Role::error_above ? b.above : b.below) = error;
}

void Row::take_text(const Column& column, const std::string& cell) {
  switch (column.role) {
    case Role::provenance:
      if (cell.find("computed") != std::string::npos || cell.find("apparent") != std::string::npos)
        o_.warnings.push_back(std::string(column.key->name) + ": " + cell);
      return;
    case Role::slip_velocity_is:
      o_.slip_velocity_is = friction_ratio::measure_named(cell);
      return;
    case Role::rupture_velocity_is:
      o_.rupture_velocity_is = rupture_velocity_meaning(cell);
      return;
    case Role::stress_drop_is:
      o_.stress_drop_is = stress_drop_meaning(cell);
      return;
    case Role::front_threshold:
      o_.front_threshold = parse_front_threshold(cell);
      return;
    default:
      break;
  }
  std::string* const text = column.role == Role::name         ? &o_.name
                            : column.role == Role::identifier ? &identifier_
                            : column.role == Role::date       ? &o_.date
                            : column.role == Role::year       ? &year_
                            : column.role == Role::month      ? &month_
                            : column.role == Role::day        ? &day_
                            : column.role == Role::kind       ? &o_.kind
                            : column.role == Role::citation   ? &o_.citation
                            : column.role == Role::note       ? &o_.note
                                                              : nullptr;
  if (text && text->empty()) *text = cell;
}

/// Reads a cell; what is wrong with it gets the column's title.
void Row::take(const Column& column, const std::string& cell) {
  try {
    if (column.is_error())
      take_error(column, cell);
    else if (column.is_quantity())
      take_number(column, cell);
    else
      take_text(column, cell);
  } catch (const InputError& error) {
    Complaint c = error.complaint();
    c.key = column.title;
    throw InputError(c);
  }
}

/// A range from its two ends, where the quantity itself was left blank.
void Row::close_range(const FurtherCells& b) {
  if (!b.low && !b.high) return;
  auto& target = o_.*b.column->key->measured;
  if (target) return;
  if (!b.low || !b.high) {
    o_.warnings.push_back("only one end of the range of " + std::string(b.column->key->name) + " is known: not used");
  } else if (b.low->low > b.high->high) {
    throw InputError({.key = b.column->title, .problem = "the range runs downwards", .allowed = "min <= max"});
  } else {
    target = Measured{b.low->low, b.high->high};
  }
}

/// The value of a quantity as the row gives it. Absent if it has none.
std::optional<Measured> Row::value_of(const Key& key) const {
  if (key.measured) return o_.*key.measured;
  for (const UncertainConstant& c : o_.uncertain_constants)
    if (c.member == key.constant) return c.measured;
  const auto& constant = o_.*key.constant;
  if (!constant) return std::nullopt;
  return Measured{*constant, *constant};
}

void Row::add_error(const FurtherCells& b) {
  const Key& key = *b.column->key;
  const auto value = value_of(key);
  if ((!b.error && !b.above && !b.below) || !value) return;
  const auto refuse = [&](const char* problem) {
    throw InputError({.key = b.column->title, .problem = problem, .allowed = "one error for each value"});
  };
  if (!value->is_exact()) refuse("the value has an error of its own");
  if (b.error && (b.above || b.below)) refuse("two kinds of error");
  const std::string name(key.name);
  if (!b.error && (!b.above || !b.below)) {
    o_.warnings.push_back("only one of the two errors of " + name + " is known: not used");
    return;
  }
  const double unit = b.in_percent ? std::fabs(value->low) : 1;
  const double above = unit * b.above.value_or(b.error.value_or(0)),
               below = unit * b.below.value_or(b.error.value_or(0));
  if (above == 0 && below == 0) {
    o_.warnings.push_back("the error of " + name + " is 0: the value is taken as exact");
    return;
  }
  if (above == 0 || below == 0) refuse("one of the two errors is 0");
  const Measured measured = split(value->low, above, below);
  if (key.constant)
    o_.uncertain_constants.push_back({key.constant, measured});
  else
    o_.*key.measured = measured;
}

void Row::finish() {
  for (const FurtherCells& b : further_) {
    if (b.column->key->measured) close_range(b);
    add_error(b);
  }
  if (is_peak_ && !o_.slip_velocity_is) o_.slip_velocity_is = Measure::peak;
  if (o_.name.empty()) o_.name = identifier_;
  if (!o_.date.empty() || year_.empty()) return;
  const auto two = [](const std::string& text) { return text.size() == 1 ? "0" + text : text; };
  o_.date = year_;
  if (!month_.empty()) o_.date += "-" + two(month_);
  if (!month_.empty() && !day_.empty()) o_.date += "-" + two(day_);
}

}  // namespace

bool is_absent(std::string_view cell, const std::vector<std::string>& missing) {
  cell = trimmed(cell);
  if (cell.empty() || std::find(missing.begin(), missing.end(), cell) != missing.end()) return true;
  std::string small(cell);
  for (char& c : small)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  constexpr std::string_view words[] = {
      "nan", "-nan",         "n/a",      "na",          "n.a.", "null",         "none",         "-",
      "--",  "---",          "?",        "*",           "n.d.", "\xE2\x80\x93", "\xE2\x80\x94", "unknown",
      "...", "\xE2\x80\xA6", "\xC2\xA0", "\xE2\x88\x92"};
  if (std::find(std::begin(words), std::end(words), small) != std::end(words)) return true;
  const auto number = medium::number(cell);
  return number && (*number == -99 || *number == -999 || *number == -9999);
}

Entry read_row(const Layout& layout, const std::vector<std::string>& missing, const std::vector<std::string>& cells,
               std::size_t line, const std::string& file) {
  const std::vector<Column>& columns = layout.columns;
  Entry entry;
  Observation& o = entry.observation;
  o.file = file;
  o.line = line;
  Row row(o, layout);
  try {
    const std::size_t both = std::min(columns.size(), cells.size());
    for (std::size_t i = 0; i < both; ++i)
      if (columns[i].role == Role::name && o.name.empty()) o.name = cells[i];
    const bool more = std::any_of(cells.begin() + static_cast<std::ptrdiff_t>(both), cells.end(),
                                  [](const std::string& cell) { return !trimmed(cell).empty(); });
    if (cells.size() < columns.size() || more)
      throw InputError(
          {.problem = "the row has " + std::to_string(cells.size()) + (cells.size() == 1 ? " cell" : " cells"),
           .allowed = std::to_string(columns.size()) + " cells, as in the header"});
    for (std::size_t i = 0; i < columns.size(); ++i)
      if (columns[i].role != Role::unknown && columns[i].role != Role::unused && !is_absent(cells[i], missing))
        row.take(columns[i], cells[i]);
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
