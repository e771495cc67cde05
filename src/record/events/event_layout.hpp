#pragma once
/// \file
/// The variables in the file of a catalogue that are not columns of the events.

#include <limits>
#include <vector>

#include "catalogue/population.hpp"
#include "foundation/math/constants.hpp"
#include "record/netcdf/netcdf.hpp"
#include "results/columns.hpp"

namespace slipfront::record::event_layout {

inline constexpr const char* state = "done";

/// A variable of numbers with its values. `about.get` is not used.
struct Variable {
  results::NumberColumn about;
  std::vector<int> dimensions;
  std::vector<double> values;
};

/// The variables of the decades of rupture velocity, with quantiles over the dimension `quantile` of the file. It also
/// has the closed form over these decades, on a separate dimension.
std::vector<Variable> population_variables(netcdf::Writer& file, const std::vector<catalogue::Decade>& population,
                                           int quantile);

}  // namespace slipfront::record::event_layout
