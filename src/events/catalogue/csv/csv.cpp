#include "events/catalogue/csv/csv.hpp"

#include <algorithm>
#include <set>

#include "events/catalogue/format.hpp"
#include "text/characters.hpp"
#include "text/csv_records.hpp"
#include "text/file_kind.hpp"
#include "text/units.hpp"

namespace slipfront::catalogue {
namespace {

using Role = Column::Role;

/// A table whose columns are understood before its rows are read.
class CsvTable {
 public:
  CsvTable(std::string_view text, const std::string& file, const TableOptions& options);

  /// \throws InputError if the table as a whole cannot be read.
  void require_readable() const;
  /// Passes the rows on.
  void read(const Sink& sink) const;
  TableNotes notes() const;
  TableDescription description() const;

 private:
  /// Numbers and texts in a column, and the numbers without a unit.
  struct Count {
    std::size_t numbers = 0, texts = 0, bare = 0;
  };

  template <class Take, class Comment>
  std::size_t for_each_row(Take&& take, Comment&& comment) const;
  void count(const std::vector<std::string>& cells);
  void find_missing_units();
  bool describes_subfaults() const;
  std::string title(std::size_t column) const;
  bool looks_like_quantity(std::size_t column) const;

  std::string storage_;
  std::string_view text_;
  const std::string& file_;
  const TableOptions& options_;
  ColumnMap map_;
  Layout layout_;
  std::vector<Count> counts_;
  std::vector<std::string> notes_;
  std::size_t rows_ = 0, open_quote_ = 0;
};

CsvTable::CsvTable(std::string_view text, const std::string& file, const TableOptions& options)
    : text_(text), file_(file), options_(options), map_(parse_column_map(options)) {
  if (text_.starts_with("\xFF\xFE") || text_.starts_with("\xFE\xFF"))
    throw InputError({.line = 1, .problem = "the text is UTF-16", .allowed = "UTF-8 or Latin-1"});
  if (text_.starts_with("\xEF\xBB\xBF")) text_.remove_prefix(3);
  if (auto utf8 = lines_in_utf8(text_)) text_ = storage_ = std::move(*utf8);
  if (trimmed(text_).empty())
    throw InputError({.problem = "the file is empty", .allowed = "a CSV header line and one row an event"});
  layout_ = find_layout(text_, map_);
  if (layout_.separator == ' ') text_ = storage_ = with_tabs(text_);
  counts_.resize(layout_.columns.size());
  std::size_t commented = 0, first_commented = 0;
  open_quote_ = for_each_row([&](std::vector<std::string>&& cells, std::size_t) { count(cells); },
                             [&](std::size_t line) { commented++ == 0 ? first_commented = line : 0; });
  if (commented > 0)
    notes_.push_back(file + ":" + std::to_string(first_commented) + ": comments that hold as many cells as a row: " +
                     std::to_string(commented) + "; they are not read");
  find_missing_units();
}

/// Calls `take` with the cells and the line of each row, and `comment` with the line of each comment that has as many
/// cells. Returns the line of a quote that is never closed, or 0.
template <class Take, class Comment>
std::size_t CsvTable::for_each_row(Take&& take, Comment&& comment) const {
  const char separator = layout_.separator == ' ' ? '\t' : layout_.separator;
  const auto skip = [&](std::string_view line, std::size_t number) {
    if (number <= layout_.last_head_line) return number != layout_.header_line || is_comment(line);
    if (!is_comment(line)) return false;
    const auto cells = static_cast<std::size_t>(std::count(line.begin(), line.end(), separator)) + 1;
    if (cells == layout_.columns.size() && cells > 1) comment(number);
    return true;
  };
  return for_each_record(text_,
                         [&](std::vector<std::string>&& cells, std::size_t line) {
                           const bool is_blank = std::all_of(cells.begin(), cells.end(),
                                                             [](const auto& cell) { return trimmed(cell).empty(); });
                           if (!is_blank && line > layout_.last_head_line && cells != layout_.titles)
                             take(std::move(cells), line);
                         },
                         {.separator = separator, .skip = skip});
}

void CsvTable::count(const std::vector<std::string>& cells) {
  ++rows_;
  for (std::size_t i = 0; i < std::min(cells.size(), counts_.size()); ++i) {
    const Column& c = layout_.columns[i];
    const bool matters = c.role == Role::unknown || (c.is_quantity() && c.unit.empty());
    if (!matters || is_absent(cells[i], map_.missing)) continue;
    std::string text = medium::plain_number(cells[i]);
    std::replace(text.begin(), text.end(), ',', '.');
    if (!text.empty() && std::string_view("<>~").find(text.front()) != std::string_view::npos) text.erase(0, 1);
    const bool is_number = medium::number(text) || (text.find("+-") != std::string::npos && text.front() <= '9');
    ++(is_number ? counts_[i].numbers : counts_[i].texts);
    if (std::none_of(text.begin(), text.end(), [](char one) { return is_letter(one) && one != 'e' && one != 'E'; }))
      ++counts_[i].bare;
  }
}

/// A column whose numbers all lack a unit is refused, or not used if it only serves to derive others.
void CsvTable::find_missing_units() {
  for (std::size_t i = 0; i < counts_.size(); ++i) {
    Column& c = layout_.columns[i];
    if (!c.is_quantity() || !c.unit.empty() || c.key->dimension == medium::Dimension::ratio || c.refusal) continue;
    if (counts_[i].bare == 0 || counts_[i].bare < counts_[i].numbers + counts_[i].texts) continue;
    const std::string unit(medium::si_unit(c.key->dimension));
    if (is_auxiliary(*c.key)) {
      notes_.push_back(file_ + ":" + std::to_string(layout_.header_line) + ": column '" + title(i) +
                       "' has no unit: not used");
      c = {.role = Role::unused, .title = c.title};
      c.reason = "no unit";
    } else if (rows_ > 1 && counts_[i].bare == rows_) {
      c.refusal = {
          .key = title(i),
          .problem = "no unit in the title, below it or in its cells",
          .allowed = "a title with the unit, such as '" + title(i) + " (" + unit + ")', or --columns map.toml"};
    }
  }
}

/// The title of a column for people.
std::string CsvTable::title(std::size_t column) const {
  const std::string title(trimmed(layout_.columns[column].title));
  return title.empty() ? "column " + std::to_string(column + 1) : title;
}

/// Whether a column that is not understood looks like a quantity.
bool CsvTable::looks_like_quantity(std::size_t column) const {
  const Column& c = layout_.columns[column];
  return c.role == Role::unknown && (c.looks_physical || (counts_[column].numbers > 0 && counts_[column].texts == 0));
}

/// Whether the rows are the subfaults of one event: slip at positions, with depths, and neither names, dates,
/// magnitudes nor velocities of events.
bool CsvTable::describes_subfaults() const {
  std::set<std::string_view> words;  // meanings of the first words of the titles
  for (const Column& c : layout_.columns) {
    const std::string_view title = trimmed(c.title), word = title.substr(0, title.find_first_of(" _([,.:\t\n"));
    words.insert(meaning_of(small_letters(word), Word::patch));
    if (c.key && c.key->name == "slip") words.insert("slip");
    for (const char* text : {"name", "date", "year", "kind"})
      if (c.text == text) return false;
    for (const char* key : {"duration", "rupture_velocity", "stress_drop", "moment_magnitude", "slip_velocity"})
      if (c.key && c.key->name == key) return false;
  }
  const bool has_slips = words.count("slip of a patch") > 0;
  return (words.count("slip") > 0 || has_slips) && (words.count("patch") > 0 || has_slips) && words.count("x") > 0 &&
         words.count("y") > 0 && words.count("depth") > 0;
}

void CsvTable::require_readable() const {
  const std::size_t line = std::max(layout_.header_line, layout_.last_head_line + (layout_.header_line == 0 ? 1 : 0));
  const auto refuse = [&](Complaint c) {
    if (c.line == 0) c.line = line;
    throw InputError(c);
  };
  for (const Column& c : layout_.columns)
    if (c.refusal) refuse(*c.refusal);
  if (describes_subfaults())
    refuse({.problem = "a table of subfaults (slip at positions and depths), not of events",
            .allowed = "one event a row; or, for each subfault, longitude, latitude, depth, length, width, strike, dip "
                       "and slip"});
  const auto has = [&](auto&& is_wanted) {
    return std::any_of(layout_.columns.begin(), layout_.columns.end(), is_wanted);
  };
  for (const std::string& name : options_.required)
    if (!has([&](const Column& c) { return c.is_quantity() && c.key->name == name; }))
      refuse({.key = name,
              .problem = "the table has no such column",
              .allowed = "a column " + name + " with its unit, or --columns map.toml"});
  const bool is_observed =
      has([](const Column& c) { return c.text == "end" || (c.is_quantity() && !is_auxiliary(*c.key)); });
  if (!is_observed) refuse_other_kinds(text_, file_, ReadAs::table);
  if (!is_observed && layout_.header_line > 0)
    refuse({.problem = "the header names no observed quantity",
            .allowed = "columns such as name, rupture_velocity_km_s, slip_velocity_m_s; or --columns map.toml"});
  if (!is_observed)
    refuse({.problem = "no line has the titles of the columns",
            .allowed = "a header, or --columns map.toml with the numbers of the columns, such as 1 = \"name\""});
  if (rows_ == 0 && open_quote_ == 0)
    throw InputError({.problem = "a header and no rows", .allowed = "a CSV header line and one row an event"});
}

void CsvTable::read(const Sink& sink) const {
  for_each_row([&](std::vector<std::string>&& cells,
                   std::size_t line) { sink(read_row(layout_, map_, options_, cells, line, file_)); },
               [](std::size_t) {});
  if (open_quote_ == 0) return;
  Entry entry;
  entry.observation.name = "line " + std::to_string(open_quote_);
  entry.observation.file = file_;
  entry.error = Complaint{.file = file_,
                          .line = open_quote_,
                          .problem = "a quote is opened and never closed",
                          .allowed = "\"...\" around a cell"};
  sink(std::move(entry));
}

TableNotes CsvTable::notes() const {
  TableNotes notes{.notes = notes_};
  for (std::size_t i = 0; i < counts_.size(); ++i) {
    const Column& c = layout_.columns[i];
    const Count& n = counts_[i];
    if (c.is_used() || (trimmed(c.title).empty() && n.numbers + n.texts == 0)) continue;
    notes.ignored.push_back(title(i));
    if (looks_like_quantity(i)) notes.ignored_quantities.push_back(title(i));
  }
  return notes;
}

TableDescription CsvTable::description() const {
  TableDescription all{.file = file_,
                       .header_line = layout_.header_line,
                       .separator = layout_.separator,
                       .decimal_comma = layout_.decimal_comma};
  for (std::size_t i = 0; i < layout_.columns.size(); ++i) {
    const Column& c = layout_.columns[i];
    ColumnDescription column{
        .title = title(i), .meaning = meaning_of(c), .unit = c.unit, .deviations = c.is_error() ? c.deviations : 0};
    if (c.refusal)
      column.reason = c.refusal->problem + (c.refusal->value.empty() ? "" : " (" + c.refusal->value + ")") +
                      "; allowed: " + c.refusal->allowed;
    else if (!c.is_used())
      column.reason = !c.reason.empty()        ? c.reason
                      : c.role == Role::unused ? "slipfront does not need it"
                                               : "no name of a quantity";
    column.looks_physical = looks_like_quantity(i);
    all.columns.push_back(std::move(column));
  }
  all.map = map_text(all, map_);
  return all;
}

/// Calls `use` with the table. An error gets the name of the file.
template <class Use>
auto with_table(std::string_view text, const std::string& file, const TableOptions& options, Use&& use) {
  try {
    return use(CsvTable(text, file, options));
  } catch (const InputError& error) {
    Complaint c = error.complaint();
    if (c.file.empty()) c.file = file;
    throw InputError(c);
  }
}

}  // namespace

TableNotes read_csv(std::string_view text, const std::string& file, const Sink& sink, const TableOptions& options) {
  return with_table(text, file, options, [&](const CsvTable& table) {
    table.require_readable();
    table.read(sink);
    return table.notes();
  });
}

TableDescription describe_csv(std::string_view text, const std::string& file, const TableOptions& options) {
  return with_table(text, file, options, [](const CsvTable& table) { return table.description(); });
}

extern const Format csv_format;
const Format csv_format{.ending = ".csv", .looks_like = [](std::string_view) { return true; }, .read = read_csv};

}  // namespace slipfront::catalogue
