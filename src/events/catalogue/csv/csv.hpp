#pragma once
/// \file
/// The reader of tables. csv_names has the names of quantities, csv_title reads a title, csv_map the file of --columns;
/// csv_layout finds the header, and csv_row reads the cells.

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "events/catalogue/keys.hpp"
#include "slipfront/events/catalogue/read.hpp"

namespace slipfront::catalogue {

/// The kinds of words in titles and cells.
enum class Word { quantity, text, unused, neutral, physical, about, prefix, range, error, above, below, patch, absent };

/// The meaning of a word or of words without blanks, in small letters. For an error, it is the number of standard
/// deviations. Empty if the word is not of this kind.
std::string_view meaning_of(std::string_view word, Word kind);

/// Whether a cell stands for an absent value: blank, nan, n/a, null, none, -, ?, -99, -999, -9999, or a text of
/// `missing`.
bool is_absent(std::string_view cell, const std::vector<std::string>& missing);

/// One column of a table: its title and the meaning of its cells.
struct Column {
  enum class Role {
    unknown,  ///< free text, or a quantity that the reader does not know
    unused,   ///< known, and not needed by the theory: latitude, depth, strike, ...
    value,
    error,        ///< standard deviation of a quantity
    error_above,  ///< the part of unequal errors above the value
    error_below,
    low,  ///< ends of a range
    high,
    how,  ///< how the quantity was found
    text
  };
  Role role = Role::unknown;
  std::string title = {};                 ///< as written in the header
  const Key* key = nullptr;               ///< the quantity to which the cells belong; else null
  std::string_view text = {};             ///< meaning of a text: "name", "date", "year", "start", ...
  std::string unit = {};                  ///< unit of its cells, or "1e18 N m"; if empty, each cell must give its own
  double deviations = 1;                  ///< an error is this many standard deviations
  bool in_percent = false;                ///< the errors are percentages of the value
  bool is_largest = false;                ///< the title states the largest value on the fault
  bool is_static = false;                 ///< the title states a static stress drop
  bool looks_physical = false;            ///< an unknown title has a unit, or a word of a quantity
  std::string assumption = {};            ///< a warning for each event that has a value in this column
  std::string reason = {};                ///< why the column is not used
  std::optional<Complaint> refusal = {};  ///< why the table cannot be read with this column

  bool is_quantity() const { return role == Role::value || role == Role::low || role == Role::high; }
  bool is_error() const { return role == Role::error || role == Role::error_above || role == Role::error_below; }
  bool is_used() const { return role != Role::unknown && role != Role::unused; }
};

/// The meaning of a column in words of the map, such as "error of slip". Empty if the column is not used.
std::string meaning_of(const Column& column);

/// Reads a header cell, such as `rupture_velocity_km_s`, `Rupture Velocity (km/s)`, `rv_min_km_day`, `slip_err [cm]` or
/// `name`. A bare error such as "err", "sd" or "+-" belongs to the last of the columns before it.
Column title_column(const std::string& title, const std::vector<Column>& before, const std::vector<Key>& keys);

/// Decides between columns of one quantity.
void settle_columns(std::vector<Column>& columns);

/// Quantities that only serve to derive others. A second column of one of them, and one without a unit, are not used.
bool is_auxiliary(const Key& key);

/// How a table is written, as its user states it in the file of --columns.
struct ColumnMap {
  struct Meaning {
    Column column;
    std::size_t line;  ///< in the map
  };
  std::string file;                        ///< name of the file with the map, for error messages
  std::map<std::string, Meaning> columns;  ///< by title, or by number if no column has this title
  std::optional<char> separator;           ///< ' ' for any number of blanks and tabs
  bool decimal_comma = false;
  std::size_t skip_lines = 0;        ///< lines before the header
  std::vector<std::string> missing;  ///< cells that stand for an absent value, in addition to the common ones
  const std::vector<Key>* keys = &quantity_keys();

  /// The columns of a header, by the map first. \throws InputError for a column of the map that the table lacks.
  std::vector<Column> columns_of(const std::vector<std::string>& titles) const;
};

/// Parses the map of the options. \throws InputError.
ColumnMap parse_column_map(const TableOptions& options);

/// A map with all columns of a table. Those that are read without it are comments.
std::string map_text(const TableDescription& table, const ColumnMap& map);

/// The position of the header in a table, and the form of its rows.
struct Layout {
  char separator = ',';  ///< between the cells of a row; ' ' for any number of blanks
  bool decimal_comma = false;
  std::size_t header_line = 0;      ///< 0 if no line has titles
  std::size_t last_head_line = 0;   ///< line of the header, or of the units below it; the rows follow
  std::vector<std::string> titles;  ///< as written, or "column 1", "column 2", ...
  std::vector<Column> columns;
};

/// The text of a table whose cells are separated by blanks, with a tab between the cells.
std::string with_tabs(std::string_view text);

/// Whether the line is a comment: its first character is '#' or '%'.
bool is_comment(std::string_view line);

/// Finds the header within the first lines of a table. It tries each separator, and takes the line with most titles
/// that it knows. \throws InputError if the map does not fit.
Layout find_layout(std::string_view text, const ColumnMap& map);

/// Reads one row. What is wrong with it is the error of the entry.
Entry read_row(const Layout& layout, const ColumnMap& map, const TableOptions& options,
               const std::vector<std::string>& cells, std::size_t line, const std::string& file);

}  // namespace slipfront::catalogue
