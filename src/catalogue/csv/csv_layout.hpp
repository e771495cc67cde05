#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "catalogue/csv/csv_map.hpp"

namespace slipfront::catalogue {

/// The position of the header in a table, and the form of its rows.
struct Layout {
  char separator = ',';
  bool decimal_comma = false;
  std::size_t header_line = 0;
  std::size_t last_head_line = 0;   ///< line of the header, or of the units below it; the rows follow
  std::vector<std::string> titles;  ///< as written
  std::vector<Column> columns;
};

/// Whether the line is a comment: its first character is '#' or '%'.
bool is_comment(std::string_view line);

/// Finds the header within the first lines of a table. It tries each separator, and takes the line with most titles
/// that it knows. \throws InputError (line, key, problem, allowed) if there is none, or the header is wrong.
Layout find_layout(std::string_view text, const ColumnMap& map);

}  // namespace slipfront::catalogue
