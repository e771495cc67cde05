#pragma once
/// \file
/// Runs work in a separate process.

#include <functional>
#include <string>

namespace slipfront::record {

/// Runs `work` in a copy of this process and returns the bytes that `work` returns. The NetCDF and HDF5 libraries crash
/// if an allocation fails or a file is damaged; then only the copy crashes. Exceptions of `work` are thrown here too:
/// InputError and FileError unchanged, others as std::bad_alloc or FileError. `work` may write to open descriptors. All
/// its other effects are lost with the copy. If no process can be started, `work` runs in this process.
/// The copy may use `seconds` of processor time; 0 means no limit. Time in which a busy machine does not run it does
/// not count. \throws FileError with `name` and `failed` if the copy crashed or took longer.
std::string isolated(const std::string& name, const std::string& failed, const std::function<std::string()>& work,
                     unsigned long seconds = 0);

}  // namespace slipfront::record
