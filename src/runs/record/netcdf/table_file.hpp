#pragma once
/// \file
/// Tables from separate files: initial profiles and friction laws.

#include <string>
#include <string_view>
#include <vector>

namespace slipfront::record {

/// Reads the rows of some columns, at least one, in the order of the file; all numbers are finite. The extension of
/// `path` gives the format. A .csv file has a header line with columns of these names; other columns are ignored. A .nc
/// file (any NetCDF) has one-dimensional variables of these names and of equal length. Three columns may also be two
/// coordinates and a variable over the second and the first of them, such as slip(y, x). The caller checks the order
/// and the signs. \throws FileError if the file cannot be read, InputError (file, line, key, value, allowed) if its
/// content is wrong.
std::vector<std::vector<double>> read_table(const std::string& path, const std::vector<std::string>& columns);

/// Like `read_table`, for a file that has been read.
std::vector<std::vector<double>> table_of(std::string_view content, const std::string& path,
                                          const std::vector<std::string>& columns);

}  // namespace slipfront::record
