#pragma once
/// \file
/// NetCDF files as they lie on the disk: the one place that writes them, and the one that reads them back.

#include <cstddef>
#include <functional>
#include <string>
#include <string_view>

#include "record/netcdf/netcdf.hpp"

namespace slipfront::record {

/// Writes what `fill` puts into a file, sealed (seal.hpp), whole or not at all. \throws FileError (one line: path and
/// reason), also where the NetCDF library crashes.
void write_netcdf(const std::string& path, std::size_t expected_size, const std::function<void(netcdf::Writer&)>& fill);

/// The bytes that `take` makes of a NetCDF image. \throws what `take` throws; FileError where the library crashes, or
/// uses the processor for longer than 30 s and a second for each megabyte.
std::string read_netcdf(const std::string& path, std::string_view image, std::size_t most_bytes,
                        const std::function<std::string(const netcdf::Reader&)>& take);

}  // namespace slipfront::record
