#pragma once

#include <functional>

#include "scenario/text/section.hpp"
#include "slipfront/scenario/scenario.hpp"

namespace slipfront::scenario {

/// The slip of the grid that the key "file" names, with columns x, y and slip: one row for each pair of an x and a y.
/// Between the points slip is monotone along x and y (Fritsch and Carlson), so that it is never negative.
/// \throws InputError for a file that is not a grid or that does not cover the plane; what `tables` throws.
std::function<double(double x, double y)> read_grid(const Section& section, const TableReader& tables,
                                                    const Plane& plane);

}  // namespace slipfront::scenario
