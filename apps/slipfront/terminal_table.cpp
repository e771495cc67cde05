#include "terminal_table.hpp"

#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <iterator>
#include <numeric>
#include <utility>

#include "text/characters.hpp"

namespace {

constexpr std::size_t least_name = 8;  // characters of a name; with fewer, many names look equal
constexpr std::size_t usual_width = 80;

bool has_width = true;

bool begins_character(char byte) { return (static_cast<unsigned char>(byte) & 0xC0u) != 0x80u; }

/// A cell of this width. A longer one is cut.
std::string shortened(const std::string& cell, std::size_t width) {
  return characters(cell) <= width ? cell : cell.substr(0, after_characters(cell, width - 1)) + "…";
}

/// Whether the blank is next to a sign of equality, as in "t = 0".
bool is_in_equation(std::string_view text, std::size_t blank) {
  return text[blank - 1] == '=' || text.substr(blank + 1).starts_with('=');
}

/// The blank before a short unit, as in ", in mu A / pi", if `blank` is within it; otherwise `blank`.
std::size_t before_unit(std::string_view text, std::size_t blank) {
  constexpr std::string_view begin = ", in ";
  constexpr std::size_t longest = 20;
  const std::size_t comma = text.rfind(begin, blank);
  if (comma == std::string_view::npos || comma == 0 || blank < comma + begin.size() - 1) return blank;
  const std::size_t end = std::min(text.find(';', comma), text.size());
  return blank < end && end - comma <= longest ? comma + 1 : blank;
}

std::string without_trailing_blanks(std::string_view line) {
  return std::string(line.substr(0, line.find_last_not_of(' ') + 1));
}

std::size_t measured_width(int stream) {
  if (isatty(stream) == 0) return usual_width;
  std::size_t width = 0;
  if (const char* const wanted = std::getenv("COLUMNS")) {
    const std::string_view text = wanted;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), width);
    if (error == std::errc() && end == text.data() + text.size() && width > 0) return width;
  }
  winsize size{};
  if (ioctl(stream, TIOCGWINSZ, &size) != 0 || size.ws_col == 0) return usual_width;
  return size.ws_col;
}

}  // namespace

std::size_t characters(std::string_view text) {
  return static_cast<std::size_t>(std::count_if(text.begin(), text.end(), begins_character));
}

std::size_t after_characters(std::string_view text, std::size_t count) {
  for (std::size_t i = 0; i < text.size(); ++i)
    if (begins_character(text[i]) && count-- == 0) return i;
  return text.size();
}

void print_whole_lines() { has_width = false; }

std::optional<std::size_t> terminal_width() {
  static const std::size_t width = measured_width(STDOUT_FILENO);
  return has_width ? std::optional(width) : std::nullopt;
}

std::string with_reason(std::string meaning, const std::string& reason) {
  if (!reason.empty()) meaning += "; none, because " + reason;
  return meaning;
}

namespace {

/// Breaks a line at blanks into lines of at most `width` characters, unless a word is longer.
std::string broken(std::string_view rest, std::size_t indent, std::size_t width) {
  indent = std::min(indent, 2 * width / 3);
  std::string out;
  while (true) {
    const std::size_t end = after_characters(rest, width - (out.empty() ? 0 : indent));
    std::size_t blank = end == rest.size() ? std::string_view::npos : rest.rfind(' ', end);
    while (blank != std::string_view::npos && blank > 0 && is_in_equation(rest, blank))
      blank = rest.rfind(' ', blank - 1);
    if (blank != std::string_view::npos) blank = before_unit(rest, blank);
    if (end < rest.size() && (blank == std::string_view::npos || blank < rest.find_first_not_of(' ')))
      blank = rest.find(' ', end);
    const std::size_t next = blank == std::string_view::npos ? blank : rest.find_first_not_of(' ', blank);
    if (next == std::string_view::npos) return out + without_trailing_blanks(rest) + "\n";
    out += without_trailing_blanks(rest.substr(0, blank)) + "\n" + std::string(indent, ' ');
    rest.remove_prefix(next);
  }
}

}  // namespace

std::string fitted(std::string_view line, std::size_t indent) {
  const std::optional<std::size_t> width = terminal_width();
  return width ? broken(slipfront::printable(line), indent, *width) : std::string(line) + "\n";
}

std::string fitted_message(std::string_view line) {
  const bool is_shown = has_width && isatty(STDERR_FILENO) != 0;
  return is_shown ? broken(line, 2, measured_width(STDERR_FILENO)) : std::string(line) + "\n";
}

std::string fitted_help(std::string_view help) {
  constexpr std::size_t column = 30;  // the meanings begin here
  const std::size_t examples = std::min(help.find("\nExamples:"), help.size());
  std::string out;
  for (std::string_view rest = help.substr(0, examples); !rest.empty();) {
    const std::size_t end = std::min(rest.find('\n'), rest.size());
    out += fitted(rest.substr(0, end), rest.starts_with(' ') ? column : 0);
    rest.remove_prefix(std::min(end + 1, rest.size()));
  }
  return out.append(help.substr(examples));
}

void TerminalTable::add(std::vector<std::string> cells, Label label) {
  add({Row::Kind::cells, std::move(cells), label});
}

void TerminalTable::add_title(const std::string& line) { add({Row::Kind::title, {line}}); }

void TerminalTable::add_note(const std::string& line) { add({Row::Kind::note, {line}}); }

void TerminalTable::add(Row&& row) {
  if (!terminal_width()) {
    text_ += line_of(row, whole());
    return;
  }
  for (std::string& cell : row.cells) cell = slipfront::printable(cell);
  rows_.push_back(std::move(row));
}

void TerminalTable::append(TerminalTable&& more) {
  text_ += more.text_;
  std::move(more.rows_.begin(), more.rows_.end(), std::back_inserter(rows_));
}

std::string TerminalTable::line_of(const Row& row, const Block& block) const {
  if (row.kind != Row::Kind::cells) return fitted(row.cells.front(), 2);
  std::string line;
  for (const std::size_t i : block.shown) {
    if (i >= row.cells.size()) break;
    if (i > 0) line.append(std::max(columns_[i].gap, block.least_gap), ' ');
    const std::string cell = block.least_gap > 0 ? shortened(row.cells[i], block.widths[i]) : row.cells[i];
    const std::string padding(block.widths[i] - std::min(block.widths[i], characters(cell)), ' ');
    const bool is_left = columns_[i].is_left && (i > 0 || row.label == Label::left);
    line += is_left ? cell + (i + 1 < columns_.size() ? padding : "") : padding + cell;
  }
  return (block.least_gap > 0 ? without_trailing_blanks(line) : line) + "\n";
}

/// Whether the block has no cell of this row, except perhaps the first.
bool TerminalTable::is_empty(const Row& row, const Block& block) {
  return row.kind == Row::Kind::cells && std::all_of(block.shown.begin(), block.shown.end(), [&](std::size_t i) {
           return i == 0 || i >= row.cells.size() || row.cells[i].empty();
         });
}

std::string TerminalTable::text_of(const Block& block, bool with_notes) const {
  std::string text;
  for (const Row& row : rows_)
    if (!is_empty(row, block) && (with_notes || row.kind != Row::Kind::note)) text += line_of(row, block);
  return text;
}

TerminalTable::Block TerminalTable::whole() const {
  Block block;
  block.shown.resize(columns_.size());
  std::iota(block.shown.begin(), block.shown.end(), std::size_t{0});
  for (const TableColumn& column : columns_) block.widths.push_back(column.width);
  return block;
}

bool TerminalTable::fits(const Block& block, std::size_t width) const {
  return std::all_of(rows_.begin(), rows_.end(), [&](const Row& row) {
    return row.kind != Row::Kind::cells || characters(line_of(row, block)) <= width + 1;  // with the line break
  });
}

/// Blocks that fit, with columns as narrow as their cells. A block has at least one column in addition to the first.
std::vector<TerminalTable::Block> TerminalTable::blocks(std::size_t width) const {
  std::vector<std::size_t> widths(columns_.size(), 1), needed;
  for (const Row& row : rows_)
    for (std::size_t i = 0; row.kind == Row::Kind::cells && i < row.cells.size(); ++i)
      widths[i] = std::max(widths[i], characters(row.cells[i]));
  for (std::size_t i = 0; i < widths.size(); ++i)
    needed.push_back(widths[i] + (i > 0 ? std::max(columns_[i].gap, std::size_t{1}) : 0));
  const std::size_t widest = *std::max_element(needed.begin() + 1, needed.end());
  widths[0] = std::min(widths[0], std::max(width > widest ? width - widest : 0, least_name));
  std::vector<Block> all;
  std::size_t used = width;
  for (std::size_t i = 1; i < needed.size(); ++i) {
    if (all.empty() || used + needed[i] > width) {
      all.push_back({{0}, widths, 1});
      used = widths[0];
    }
    all.back().shown.push_back(i);
    used += needed[i];
  }
  return all;
}

std::string TerminalTable::text() const {
  const std::optional<std::size_t> width = terminal_width();
  if (!width) return text_;
  if (fits(whole(), *width)) return text_of(whole(), true);
  std::string text;
  for (const Block& block : blocks(*width)) text += (text.empty() ? "" : "\n") + text_of(block, text.empty());
  return text;
}
