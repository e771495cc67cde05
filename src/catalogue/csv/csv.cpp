#include <algorithm>
#include <optional>

#include "catalogue/csv/csv_layout.hpp"
#include "catalogue/csv/csv_row.hpp"
#include "catalogue/csv/csv_subfaults.hpp"
#include "catalogue/format.hpp"
#include "foundation/text/csv_records.hpp"
#include "foundation/text/latin1.hpp"
#include "foundation/text/trimmed.hpp"
#include "medium/plain_text.hpp"

namespace slipfront::catalogue {
namespace {

using Role = Column::Role;

/// The text in UTF-8 with the line ends that the reader knows. A line that is not UTF-8 is read as Latin-1. Nothing if
/// no change is needed.
std::optional<std::string> repaired(std::string_view text) {
  const bool old_ends = text.find('\r') != std::string_view::npos && text.find('\n') == std::string_view::npos;
  if (!old_ends && is_utf8(text)) return std::nullopt;
  std::string out;
  const char end_of_line = old_ends ? '\r' : '\n';
  while (!text.empty()) {
    const std::size_t end = std::min(text.find(end_of_line), text.size());
    const std::string_view line = text.substr(0, end);
    out += is_utf8(line) ? std::string(line) : from_latin1(line);
    if (end < text.size()) out += '\n';
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return out;
}

void refuse_utf16(std::string_view text) {
  if (text.starts_with("\xFF\xFE") || text.starts_with("\xFE\xFF"))
    throw InputError({.line = 1, .problem = "the text is UTF-16", .allowed = "UTF-8 or Latin-1"});
}

/// Counts the cells of the columns that the reader does not know.
class UnknownColumns {
 public:
  explicit UnknownColumns(const std::vector<Column>& columns) : columns_(columns), counts_(columns.size()) {}

  void take(const std::vector<std::string>& cells, const std::vector<std::string>& missing) {
    for (std::size_t i = 0; i < std::min(cells.size(), columns_.size()); ++i) {
      if (columns_[i].role != Role::unknown || is_absent(cells[i], missing)) continue;
      ++(is_numeric(cells[i]) ? counts_[i].numbers : counts_[i].texts);
    }
  }

  void report(TableNotes& notes) const {
    for (std::size_t i = 0; i < columns_.size(); ++i) {
      const Column& c = columns_[i];
      if (c.role != Role::unknown && c.role != Role::unused) continue;
      const bool is_empty = counts_[i].numbers + counts_[i].texts == 0;
      std::string title(trimmed(c.title));
      if (title.empty() && is_empty) continue;
      if (title.empty()) title = "column " + std::to_string(i + 1);
      notes.ignored.push_back(title);
      const bool numbers_only = counts_[i].numbers > 0 && counts_[i].texts == 0;
      if (c.role == Role::unknown && (c.looks_physical || numbers_only)) notes.ignored_quantities.push_back(title);
    }
  }

 private:
  static bool is_numeric(const std::string& cell) {
    std::string text = medium::plain_number(cell);
    std::replace(text.begin(), text.end(), ',', '.');
    if (!text.empty() && std::string_view("<>~").find(text.front()) != std::string_view::npos) text.erase(0, 1);
    return medium::number(text).has_value() || (text.find("+-") != std::string::npos && text.front() <= '9');
  }

  struct Count {
    std::size_t numbers = 0, texts = 0;
  };
  const std::vector<Column>& columns_;
  std::vector<Count> counts_;
};

void require_observed_quantity(const Layout& layout) {
  const bool any = std::any_of(layout.columns.begin(), layout.columns.end(),
                               [](const Column& c) { return c.is_quantity() && !is_auxiliary(*c.key); });
  if (!any)
    throw InputError(
        {.line = layout.header_line,
         .problem = "the header names no observed quantity",
         .allowed = "columns such as name, rupture_velocity_km_s, slip_velocity_m_s; or --columns map.toml"});
}

/// Reads the rows below the header.
class Rows {
 public:
  Rows(const Layout& layout, const ColumnMap& map, const std::string& file, const Sink& sink)
      : layout_(layout), map_(map), file_(file), sink_(sink), unknown_(layout.columns) {}

  /// Returns the line of a quote that is never closed, or 0.
  std::size_t read(std::string_view text) {
    const auto skip = [this](std::string_view line, std::size_t number) {
      if (number <= layout_.last_head_line) return number != layout_.header_line || is_comment(line);
      if (!is_comment(line)) return false;
      note_comment(line, number);
      return true;
    };
    return for_each_record(text,
                           [this](std::vector<std::string>&& cells, std::size_t line) { take(std::move(cells), line); },
                           {.separator = layout_.separator, .skip = skip});
  }

  std::size_t count() const { return count_; }

  void report(TableNotes& notes) const {
    unknown_.report(notes);
    if (commented_ > 0)
      notes.notes.push_back(file_ + ":" + std::to_string(first_commented_) +
                            ": comments that hold as many cells as a row: " + std::to_string(commented_) +
                            "; they are not read");
  }

 private:
  void take(std::vector<std::string>&& cells, std::size_t line) {
    const bool is_blank =
        std::all_of(cells.begin(), cells.end(), [](const auto& cell) { return trimmed(cell).empty(); });
    if (is_blank || line <= layout_.last_head_line || cells == layout_.titles) return;
    ++count_;
    unknown_.take(cells, map_.missing);
    sink_(read_row(layout_, map_.missing, cells, line, file_));
  }

  void note_comment(std::string_view line, std::size_t number) {
    const auto cells = static_cast<std::size_t>(std::count(line.begin(), line.end(), layout_.separator)) + 1;
    if (cells != layout_.columns.size() || cells < 2) return;
    if (commented_++ == 0) first_commented_ = number;
  }

  const Layout& layout_;
  const ColumnMap& map_;
  const std::string& file_;
  const Sink& sink_;
  UnknownColumns unknown_;
  std::size_t count_ = 0, commented_ = 0, first_commented_ = 0;
};

TableNotes read_table(std::string_view text, const std::string& file, const Sink& sink, const ColumnMap& map) {
  refuse_utf16(text);
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
  const std::optional<std::string> utf8 = repaired(text);
  if (utf8) text = *utf8;
  if (trimmed(text).empty())
    throw InputError({.problem = "the file is empty", .allowed = "a CSV header line and one row an event"});
  const Layout layout = find_layout(text, map);
  refuse_subfaults(layout);
  require_observed_quantity(layout);
  Rows rows(layout, map, file, sink);
  const std::size_t open_quote = rows.read(text);
  if (open_quote != 0) {
    Entry entry;
    entry.observation.name = "line " + std::to_string(open_quote);
    entry.observation.file = file;
    entry.error = Complaint{.file = file,
                            .line = open_quote,
                            .problem = "a quote is opened and never closed",
                            .allowed = "\"...\" around a cell"};
    sink(std::move(entry));
  } else if (rows.count() == 0) {
    throw InputError({.problem = "a header and no rows", .allowed = "a CSV header line and one row an event"});
  }
  TableNotes notes;
  rows.report(notes);
  return notes;
}

}  // namespace

TableNotes read_csv(std::string_view text, const std::string& file, const Sink& sink, const TableOptions& options) {
  const ColumnMap map = parse_column_map(options.map, options.map_file);
  try {
    return read_table(text, file, sink, map);
  } catch (const InputError& error) {
    Complaint c = error.complaint();
    if (c.file.empty()) c.file = file;
    throw InputError(c);
  }
}

extern const Format csv_format;
const Format csv_format{.ending = ".csv", .looks_like = [](std::string_view) { return true; }, .read = read_csv};

}  // namespace slipfront::catalogue
