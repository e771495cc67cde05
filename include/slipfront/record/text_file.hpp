#pragma once
/// \file
/// Whole text files.

#include <string>

namespace slipfront::record {

/// The content of a file. \throws FileError with path and reason: not there, a directory, not permitted, a read error.
std::string read_text(const std::string& path);

/// All of standard input. \throws FileError.
std::string read_standard_input();

}  // namespace slipfront::record
