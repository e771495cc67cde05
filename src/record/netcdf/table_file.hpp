#pragma once
/// \file
/// Reads curves from separate files: initial profiles and friction laws.

#include <string>
#include <utility>
#include <vector>

namespace slipfront::record {

/// Reads at least one pair (x, y), in the order of the file; all numbers are finite. The extension of `path` gives the
/// format. A .csv file has a header line with columns named `x` and `y`; other columns are ignored. A .nc file (any
/// NetCDF) has one-dimensional variables of these names and of equal length. The caller checks whether x ascends and
/// whether y may be negative. \throws FileError if the file cannot be read, InputError (file, line, key, value,
/// allowed) if its content is wrong.
std::vector<std::pair<double, double>> read_table(const std::string& path, const std::string& x, const std::string& y);

}  // namespace slipfront::record
