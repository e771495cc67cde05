#pragma once
/// \file
/// The file of a comparison: NetCDF-4 by the CF-1.10 conventions, dimensions level, time and x.

#include <optional>
#include <string>
#include <vector>

#include "record/runs/run_file.hpp"
#include "slipfront/description.hpp"

namespace slipfront::record {

inline constexpr const char* comparison_format = "comparison 1";  ///< value of the attribute slipfront_format

/// The results of one level of theory.
struct ComparedLevel {
  std::string name;
  std::optional<double> scale;  ///< scale of a chain; absent for other levels
  std::vector<output::Snapshot> snapshots;
};

/// Writes `path` completely or not at all. Every level must have a snapshot at each of `times`. \throws FileError (one
/// line: path and reason), InputError for an unknown variable, std::invalid_argument if a snapshot is missing.
void write_comparison(const std::string& path, const RunMetadata& metadata, const std::vector<double>& times,
                      const std::vector<ComparedLevel>& levels, bool finished);

}  // namespace slipfront::record
