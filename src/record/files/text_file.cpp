#include "record/files/text_file.hpp"

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <memory>
#include <system_error>

#include "foundation/machine.hpp"
#include "foundation/text/digits.hpp"
#include "record/files/whole_file.hpp"
#include "slipfront/error.hpp"

namespace slipfront::record {
namespace {

/// A device may never end. What is read takes some times its size.
double most_bytes() { return std::min(0x1p32, usable_memory() / 8); }

std::string read_all(std::FILE* file, const std::string& name) {
  const double most = most_bytes();
  std::string text;
  char buffer[1 << 16];
  while (const std::size_t size = std::fread(buffer, 1, sizeof buffer, file)) {
    text.append(buffer, size);
    if (static_cast<double>(text.size()) > most)
      throw FileError(name + ": more than " + digits(most / 1e9, 3) + " GB, or without an end");
  }
  if (std::ferror(file)) throw FileError(name + ": cannot be read: " + std::strerror(errno));
  return text;
}

struct Close {
  void operator()(std::FILE* file) const { std::fclose(file); }
};

}  // namespace

std::string read_text(const std::string& path) {
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored)) throw FileError(path + ": is a directory, not a file");
  const std::unique_ptr<std::FILE, Close> file(std::fopen(path.c_str(), "rb"));
  if (!file) throw FileError(path + ": cannot be opened: " + std::strerror(errno));
  return read_all(file.get(), path);
}

std::string read_regular(const std::string& path) {
  std::error_code error;
  if (std::filesystem::exists(path, error) && !std::filesystem::is_directory(path, error) &&
      !std::filesystem::is_regular_file(path, error))
    throw FileError(path + ": is not a regular file");
  return read_text(path);
}

void write_text(const std::string& path, const std::string& text) { replace_file(path, {text}); }

std::string read_standard_input() { return read_all(stdin, "stdin"); }

}  // namespace slipfront::record
