#pragma once
/// \file
/// Writes a kinematic source and its static stress drop as grids, for those who model dynamic ruptures, and in the
/// Standard Rupture Format (Graves 2014).

#include <string>

#include "events/finite_fault/source/source.hpp"

namespace slipfront::record {

/// Writes a NetCDF file completely or not at all. Its variables have the dimensions segment, down_dip and along_strike.
/// Segments with fewer subfaults are padded with NaN. \throws FileError with path and reason.
void write_fault_grid(const std::string& path, const finite_fault::FiniteSource& source, const std::string& version,
                      const std::string& history);

/// Version 1.0 has no rock. The reader chooses the shear modulus.
enum class SrfVersion { v1, v2 };

/// The text of the file. Its comments hold `history` and the notes of the source.
std::string srf_text(const finite_fault::FiniteSource& source, const std::string& history,
                     SrfVersion version = SrfVersion::v2);

}  // namespace slipfront::record
