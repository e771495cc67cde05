#pragma once
/// \file
/// Writes NetCDF files to the disk and reads their bytes. All other code uses these functions.

#include <cstddef>
#include <functional>
#include <string>
#include <string_view>

#include "record/netcdf/netcdf.hpp"

namespace slipfront::record {

/// Writes a file that `fill` fills, with a seal (seal.hpp), completely or not at all. \throws FileError (one line: path
/// and reason), also if the NetCDF library crashes.
void write_netcdf(const std::string& path, std::size_t expected_size, const std::function<void(netcdf::Writer&)>& fill);

/// Returns the bytes that `take` produces from a NetCDF image. \throws what `take` throws, and FileError if the library
/// crashes or uses more processor time than 30 s plus 1 s for each megabyte.
std::string read_netcdf(const std::string& path, std::string_view image, std::size_t most_bytes,
                        const std::function<std::string(const netcdf::Reader&)>& take);

}  // namespace slipfront::record
