#pragma once
/// \file
/// Work in a process of its own.

#include <functional>
#include <mutex>
#include <string>

namespace slipfront::record {

/// Does `work` in a copy of this process and gives back the bytes that it returns. The NetCDF and HDF5 libraries crash
/// where an allocation fails and where a file is damaged; a copy crashes alone. What `work` throws is thrown here:
/// InputError and FileError as they are, anything else as std::bad_alloc or FileError. It may write to descriptors that
/// are open; all else that it does is lost with the copy. Where no process can be started it is done in this one.
/// \throws FileError with `name` and `failed` if the copy crashed.
std::string isolated(const std::string& name, const std::string& failed, const std::function<std::string()>& work);

/// The lock of the NetCDF library, which is not made for threads. In a copy there is but one thread, and no lock.
std::unique_lock<std::recursive_mutex> lock_netcdf();

}  // namespace slipfront::record
