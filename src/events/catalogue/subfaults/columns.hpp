#pragma once
/// \file
/// Titles of the columns of subfaults, in any format that has columns.

#include <string_view>
#include <vector>

#include "events/catalogue/subfaults/subfaults.hpp"

namespace slipfront::catalogue::subfaults {

/// Units of the numbers whose title has none.
enum class Units { si, param };  ///< m, s, Pa; or km, cm and dyn cm

/// A column: the member of a row that it gives, or null, and the factor to SI units.
struct Column {
  double Row::*member = nullptr;
  double factor = 1;
};

/// Reads a title such as "depth", "z(km)" or "length [km]".
Column column_of(std::string_view title, Units units);

/// Reads a number. \throws InputError for a word that is none; NaN for a placeholder.
double number_in(std::string_view word, const std::string& file, std::size_t line);

/// One row of numbers. \throws InputError for another number of cells than columns.
Row row_of(const std::vector<std::string_view>& cells, const std::vector<Column>& columns, const std::string& file,
           std::size_t line);

}  // namespace slipfront::catalogue::subfaults
