#pragma once
/// \file
/// What the CF-1.10 conventions ask of every file, in the words that all of slipfront's files share.

#include <cstddef>
#include <vector>

#include "record/netcdf/netcdf.hpp"
#include "record/pulses/pulse_file.hpp"
#include "record/pulses/pulse_variables.hpp"

namespace slipfront::record::cf {

/// A variable of numbers and what is to be said of it.
int reals(netcdf::Writer& file, const Description& about, const std::vector<int>& dimensions);

/// Dimensions and variables of time and of x, which has bounds.
struct Axes {
  int time, x;  ///< dimensions
  int times, centres, bounds;
};
Axes axes(netcdf::Writer& file, std::size_t times, std::size_t cells);
void write_axes(netcdf::Writer& file, const Axes& axes, const std::vector<double>& times,
                const std::vector<double>& x_edges);

/// Attributes of the file; `format` counts up when old readers would fail. A scenario that no attribute can hold is
/// cleaned and cut.
void describe_file(netcdf::Writer& file, const PulseMetadata& metadata, const char* format, bool finished);

}  // namespace slipfront::record::cf
