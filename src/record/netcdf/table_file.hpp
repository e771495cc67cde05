#pragma once
/// \file
/// Curves that stand in a file of their own: initial profiles, friction laws.

#include <string>
#include <utility>
#include <vector>

namespace slipfront::record {

/// Pairs (x, y) in the order of the file, at least one, all finite. By the ending of `path`: .csv has a header line
/// with columns named `x` and `y`, others are ignored; .nc (any NetCDF) has one-dimensional variables of these names
/// and of equal length. Whether x ascends and y may be negative is for the caller to say. \throws FileError if it
/// cannot be read, InputError (file, line, key, value, allowed) for what it holds.
std::vector<std::pair<double, double>> read_table(const std::string& path, const std::string& x, const std::string& y);

}  // namespace slipfront::record
