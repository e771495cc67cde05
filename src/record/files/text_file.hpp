#pragma once
/// \file
/// Reads and writes whole files.

#include <string>

namespace slipfront::record {

/// Reads a file. \throws FileError with path and reason if the file is missing, a directory, not permitted or not
/// readable; if it is a device or pipe of more than 1 GB, which may never end; and if it is large and no text.
std::string read_text(const std::string& path);

/// Like `read_text`, but rejects everything except regular files, because a device may never end.
std::string read_regular(const std::string& path);

/// Writes a file completely or not at all. \throws FileError with path and reason.
void write_text(const std::string& path, const std::string& text);

/// Whether any thread is writing a file now. A signal handler may call this.
bool is_writing() noexcept;

/// Reads all of standard input. \throws FileError.
std::string read_standard_input();

}  // namespace slipfront::record
