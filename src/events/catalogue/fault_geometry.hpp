#pragma once
/// \file
/// Rows and columns of the subfaults of a segment, whatever the format of their file.

#include <numbers>

#include "events/catalogue/fault_model.hpp"

namespace slipfront::catalogue {

inline constexpr double least_gap = 10;  // m; depths that differ by less are one row, because files round positions

inline double radians(double degrees) { return degrees * std::numbers::pi / 180; }

/// Sorts the subfaults into rows of equal depth, and each row in the direction of strike. Returns the number of rows,
/// or 0 if the rows have different lengths.
std::size_t sort_into_rows(std::vector<FaultPatch>& patches, double strike);

/// Moves positions from the upper edges of subfaults to their centres.
void move_to_centres(FaultSegment& segment);

}  // namespace slipfront::catalogue
