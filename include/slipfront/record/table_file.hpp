#pragma once
/// \file
/// Initial profiles that stand in a file of their own.

#include <string>
#include <utility>
#include <vector>

namespace slipfront::record {

/// Pairs (x, stress) in the order of the file, at least one, all finite. By the ending of `path`: .csv has a header
/// line with columns x and stress, others are ignored; .nc (any NetCDF) has one-dimensional variables x and stress of
/// equal length. Whether x ascends and stress may be negative is for the caller to say. \throws FileError if it cannot
/// be read, InputError (file, line, key, value, allowed) for what it holds.
std::vector<std::pair<double, double>> read_profile_table(const std::string& path);

}  // namespace slipfront::record
