#pragma once
/// \file
/// The file of a run on a plane: NetCDF-4 by the CF-1.10 conventions, with the state from which the run can resume.

#include <string>
#include <vector>

#include "record/pulses/arrays.hpp"
#include "record/pulses/pulse_file.hpp"
#include "slipfront/plane/run.hpp"

namespace slipfront::record {

/// The variables of a run, which must outlive them.
std::vector<Array> arrays_of(const plane::Run& run);

/// Writes `path` completely or not at all, with the saved state of the run. \throws FileError (one line: path and
/// reason).
void write_plane(const std::string& path, const PulseMetadata& metadata, const plane::Run& run,
                 const std::string& state);

}  // namespace slipfront::record
