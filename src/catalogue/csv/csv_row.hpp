#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "catalogue/csv/csv_layout.hpp"

namespace slipfront::catalogue {

/// Whether a cell stands for an absent value: blank, nan, n/a, null, none, -, ?, -99, -999, -9999, or a text of
/// `missing`.
bool is_absent(std::string_view cell, const std::vector<std::string>& missing);

/// Reads one row. What is wrong with it is the error of the entry.
Entry read_row(const Layout& layout, const std::vector<std::string>& missing, const std::vector<std::string>& cells,
               std::size_t line, const std::string& file);

}  // namespace slipfront::catalogue
