#pragma once

#include <functional>

#include "scenario/text/section.hpp"
#include "slipfront/scenario/scenario.hpp"

namespace slipfront::scenario {

/// The slip of the table that the key "file" names, with columns r and slip. Inside its first r the slip is that of the
/// first row. It must end with the slip 0, and is 0 outside. `ratio` is y of the scenario over y of the problem.
/// \throws InputError; what `tables` throws.
std::function<double(double x, double y)> read_radial(const Section& section, const TableReader& tables, double ratio);

}  // namespace slipfront::scenario
