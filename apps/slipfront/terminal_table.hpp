#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

/// Number of characters (code points) of a UTF-8 text.
std::size_t characters(std::string_view text);
/// Position in a UTF-8 text after its first `count` characters.
std::size_t after_characters(std::string_view text, std::size_t count);

/// Largest number of characters in a line: COLUMNS, or else the width that the terminal reports. It is 80 if stdout is
/// not a terminal or its width is unknown, and absent after `print_whole_lines`.
std::optional<std::size_t> terminal_width();
/// Prints lines and tables at their full width, whatever the terminal (--wide).
void print_whole_lines();

/// A line of text, with its line break. It is broken at blanks to fit, and its further lines begin with `indent`
/// blanks. A word that is longer than a line stays whole, so that paths can be copied.
std::string fitted(std::string_view line, std::size_t indent = 0);

/// A message for stderr. It is broken to fit if stderr is a terminal, and stays one line otherwise, for programs.
std::string fitted_message(std::string_view line);

/// The help of a command with lines that fit. Examples stay whole, so that they can be copied.
std::string fitted_help(std::string_view help);

/// The meaning of a number, with the reason if the number has no value.
std::string with_reason(std::string meaning, const std::string& reason);

struct TableColumn {
  std::size_t width;     ///< least width, in characters
  bool is_left = false;  ///< aligned to the left
  std::size_t gap = 1;   ///< number of blanks before the column
};

/// A table for people. If it is wider than a line, it is divided into blocks of columns. Each block repeats the first
/// column, and leaves out rows that are empty otherwise.
class TerminalTable {
 public:
  enum class Label { left, right };

  /// The columns must outlive the table.
  explicit TerminalTable(std::span<const TableColumn> columns) : columns_(columns) {}

  /// Adds a row. It may end early: then nothing is printed after its last cell. `label` aligns the first cell if its
  /// column is aligned to the left.
  void add(std::vector<std::string> cells, Label label = Label::left);
  /// Adds a line above rows. Each block has it.
  void add_title(const std::string& line);
  /// Adds a line about the row above. Only the first block has it.
  void add_note(const std::string& line);
  void append(TerminalTable&& more);

  std::string text() const;

 private:
  struct Row {
    enum class Kind { cells, title, note } kind;
    std::vector<std::string> cells;  ///< a title or note has one
    Label label = Label::left;
  };
  /// The columns of a block, in order, and the widths of all columns.
  struct Block {
    std::vector<std::size_t> shown, widths;
    std::size_t least_gap = 0;
  };

  void add(Row&& row);
  std::string line_of(const Row& row, const Block& block) const;
  std::string text_of(const Block& block, bool with_notes) const;
  static bool is_empty(const Row& row, const Block& block);
  bool fits(const Block& block, std::size_t width) const;
  Block whole() const;
  std::vector<Block> blocks(std::size_t width) const;

  std::span<const TableColumn> columns_;
  std::string text_;       ///< the table so far, if lines have no largest width
  std::vector<Row> rows_;  ///< the rows so far, if they have one
};
