#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "catalogue/csv/csv_header.hpp"

namespace slipfront::catalogue {

/// How a table is written, as its user states it in the file of --columns.
struct ColumnMap {
  std::string file;                          ///< name of the file with the map, for error messages
  std::map<std::string, Column> columns;     ///< by title
  std::map<std::string, std::size_t> lines;  ///< line of each title in the map
  std::optional<char> separator;
  bool decimal_comma = false;
  std::size_t skip_lines = 0;        ///< lines before the header
  std::vector<std::string> missing;  ///< cells that stand for an absent value, in addition to the common ones
};

/// Parses the TOML text of a map. An empty text gives an empty map. \throws InputError.
ColumnMap parse_column_map(std::string_view text, const std::string& file);

/// The columns of a header, by the map first. \throws InputError as parse_columns, and for a title of the map that the
/// header does not have.
std::vector<Column> mapped_columns(const ColumnMap& map, const std::vector<std::string>& titles);

}  // namespace slipfront::catalogue
