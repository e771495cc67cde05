#pragma once
/// \file
/// What stands in the file of a catalogue besides the events' own columns.

#include <limits>
#include <vector>

#include "catalogue/population.hpp"
#include "record/netcdf/netcdf.hpp"
#include "results/columns.hpp"

namespace slipfront::record::event_layout {

inline constexpr const char* state = "done";
inline constexpr double none = std::numeric_limits<double>::quiet_NaN();

/// A variable of numbers with all that it holds; `about.get` is not used.
struct Variable {
  results::NumberColumn about;
  std::vector<int> dimensions;
  std::vector<double> values;
};

/// Decades of rupture velocity with their spreads (over `quantile`, a dimension of the file), and the closed form
/// through them over a dimension of its own.
std::vector<Variable> population_variables(netcdf::Writer& file, const std::vector<catalogue::Decade>& population,
                                           int quantile);

}  // namespace slipfront::record::event_layout
