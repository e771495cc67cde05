#pragma once
/// \file
/// Work in a process of its own.

#include <functional>
#include <string>

namespace slipfront::record {

/// Does `work` in a copy of this process and gives back the bytes that it returns. The NetCDF and HDF5 libraries crash
/// where an allocation fails and where a file is damaged; a copy crashes alone. What `work` throws is thrown here:
/// InputError and FileError as they are, anything else as std::bad_alloc or FileError. It may write to descriptors that
/// are open; all else that it does is lost with the copy. Where no process can be started it is done in this one.
/// The copy may use the processor for `seconds`; 0: without a limit. Time in which a busy machine does not run it does
/// not count. \throws FileError with `name` and `failed` if the copy crashed or took longer.
std::string isolated(const std::string& name, const std::string& failed, const std::function<std::string()>& work,
                     unsigned long seconds = 0);

}  // namespace slipfront::record
