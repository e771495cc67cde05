#pragma once
/// \file
/// The file of a comparison: NetCDF-4 by the CF-1.10 conventions, dimensions level, time and x.

#include <optional>
#include <string>
#include <vector>

#include "record/pulses/pulse_file.hpp"
#include "slipfront/description.hpp"

namespace slipfront::record {

inline constexpr const char* comparison_format = "comparison 1";  ///< slipfront_format
inline constexpr Description scale_variable = {"scale", "of a chain: x and t stretched by it, friction divided", "",
                                               "Eq. 3"};

/// One level of theory, run to its end.
struct ComparedLevel {
  std::string name;
  std::optional<double> scale;  ///< of a chain
  std::vector<output::Snapshot> snapshots;
};

/// Writes `path` whole or not at all. Every level has a snapshot at each of `times`, or this throws
/// std::invalid_argument. \throws FileError (one line: path and reason), InputError for an unknown variable.
void write_comparison(const std::string& path, const PulseMetadata& metadata, const std::vector<double>& times,
                      const std::vector<ComparedLevel>& levels, bool finished);

}  // namespace slipfront::record
