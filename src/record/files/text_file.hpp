#pragma once
/// \file
/// Whole files.

#include <string>

namespace slipfront::record {

/// The content of a file. \throws FileError with path and reason: not there, a directory, not permitted, a read error.
std::string read_text(const std::string& path);

/// The same of nothing but a regular file: a device may never end.
std::string read_regular(const std::string& path);

/// Writes a file whole or not at all. \throws FileError with path and reason.
void write_text(const std::string& path, const std::string& text);

/// Whether a file is being written now, by any thread. May be called by a signal handler.
bool is_writing() noexcept;

/// All of standard input. \throws FileError.
std::string read_standard_input();

}  // namespace slipfront::record
