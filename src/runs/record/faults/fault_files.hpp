#pragma once
/// \file
/// Writes a kinematic source and its static stress drop as grids, for those who model dynamic ruptures, and in the
/// Standard Rupture Format (Graves 2014), as .fsp and as CSV of subfaults.

#include <string>

#include "events/catalogue/fault_model.hpp"
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

/// A source and the event that it was made of, which has name, date and velocities.
struct DescribedSource {
  const finite_fault::FiniteSource& source;
  const catalogue::Observation& event;
};

/// The layout of SRCMOD. The velocity table has a layer for each depth, with the shear modulus that keeps the moment.
std::string fsp_text(const DescribedSource& described, const std::string& history);

/// One subfault a row, in SI units. Positions are the middles of upper edges, as GeoClaw reads them by default.
std::string subfaults_csv(const finite_fault::FiniteSource& source);

}  // namespace slipfront::record
