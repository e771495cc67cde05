#pragma once
/// \file
/// What the CF-1.10 conventions ask of every file, in the words that all of slipfront's files share.

#include <vector>

#include "netcdf.hpp"
#include "pulse_variables.hpp"
#include "slipfront/record/pulse_file.hpp"

namespace slipfront::record::cf {

inline constexpr Description time_axis = {"time", "time", "b / (c A)", "Eq. 3"};
inline constexpr Description x_axis = {"x", "position along the interface, centre of the cell", "b / A", "Eq. 3"};
inline constexpr Description x_ends = {"x_bounds", "ends of the cell", "b / A", "Eq. 3"};

/// A variable of numbers and what is to be said of it.
int reals(netcdf::Writer& file, const Description& about, const std::vector<int>& dimensions);

/// Attributes of the file; `format` counts up when old readers would fail. A scenario that no attribute can hold is
/// cleaned and cut.
void describe_file(netcdf::Writer& file, const PulseMetadata& metadata, const char* format, bool finished);

}  // namespace slipfront::record::cf
