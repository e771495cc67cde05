#include "slipfront/record/text_file.hpp"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <memory>
#include <system_error>

#include "slipfront/error.hpp"
#include "whole_file.hpp"

namespace slipfront::record {
namespace {

constexpr std::size_t most_bytes = std::size_t{1} << 32;  // a device may never end

std::string read_all(std::FILE* file, const std::string& name) {
  std::string text;
  char buffer[1 << 16];
  while (const std::size_t size = std::fread(buffer, 1, sizeof buffer, file)) {
    text.append(buffer, size);
    if (text.size() > most_bytes) throw FileError(name + ": more than 4 GB, or without an end");
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
