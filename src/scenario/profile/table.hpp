#pragma once

#include <string>
#include <utility>
#include <vector>

#include "scenario/text/section.hpp"
#include "slipfront/scenario/scenario.hpp"

namespace slipfront::scenario {

/// A column of a table file, and what its numbers may be.
struct Column {
  std::string name;
  Limits limits;    ///< in the unit of the model
  double unit = 1;  ///< the unit of the model in the unit of the file
};

/// The rows, in units of the model, of the table file that the key "file" of a section names, relative to the scenario.
/// \throws InputError for a number out of its limits; what `tables` throws.
std::vector<std::vector<double>> read_columns(const Section& section, const TableReader& tables,
                                              const std::vector<Column>& columns);

/// The rows of two columns: two or more, x strictly increasing. \throws InputError; what `tables` throws.
std::vector<std::pair<double, double>> read_rows(const Section& section, const TableReader& tables, const Column& x,
                                                 const Column& y);

}  // namespace slipfront::scenario
