#pragma once
/// \file
/// Writes the parts of a file that the CF-1.10 conventions require and that all files of slipfront share.

#include <cstddef>
#include <vector>

#include "record/netcdf/netcdf.hpp"
#include "record/runs/run_file.hpp"
#include "record/runs/run_variables.hpp"

namespace slipfront::record::cf {

/// Defines a variable of numbers and its attributes, in the units of `metadata`. Returns its id.
int reals(netcdf::Writer& file, const Description& about, const std::vector<int>& dimensions,
          const RunMetadata& metadata);

/// Writes the attributes of the file. The number in `format` increases when old readers would fail. A scenario that no
/// attribute can hold is cleaned and truncated.
void describe_file(netcdf::Writer& file, const RunMetadata& metadata, const char* format, bool finished);

}  // namespace slipfront::record::cf
