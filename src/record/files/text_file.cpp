#include "record/files/text_file.hpp"

#include <sys/stat.h>

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

/// Results of reading a file take some times its size.
double most_bytes() { return std::min(0x1p32, usable_memory() / 8); }
/// A pipe or a device may never end.
constexpr double most_without_end = 1e9;
/// A text of this size with a zero byte near its begin is none, so that we need not read all of it.
constexpr std::size_t surely_no_text = 1 << 24, near_begin = 1 << 16;

bool is_regular(std::FILE* file) {
  struct stat now {};
  return fstat(fileno(file), &now) == 0 && S_ISREG(now.st_mode);
}

enum class Content { text, any };

std::string read_all(std::FILE* file, const std::string& name, Content content) {
  const double most = is_regular(file) ? most_bytes() : std::min(most_without_end, most_bytes());
  std::string text;
  char buffer[1 << 16];
  while (const std::size_t size = std::fread(buffer, 1, sizeof buffer, file)) {
    text.append(buffer, size);
    if (content == Content::text && text.size() >= surely_no_text && text.size() - size < surely_no_text)
      if (const std::size_t zero = text.find('\0'); zero < near_begin)
        throw FileError(name + ": not a text: byte " + std::to_string(zero + 1) + " is zero");
    if (static_cast<double>(text.size()) > most)
      throw FileError(name + ": more than " + digits(most / 1e9, 3) + " GB, or without an end");
  }
  if (std::ferror(file)) throw FileError(name + ": cannot be read: " + std::strerror(errno));
  return text;
}

struct Close {
  void operator()(std::FILE* file) const { std::fclose(file); }
};

std::string read_path(const std::string& path, Content content) {
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored)) throw FileError(path + ": is a directory, not a file");
  const std::unique_ptr<std::FILE, Close> file(std::fopen(path.c_str(), "rb"));
  if (!file) throw FileError(path + ": cannot be opened: " + std::strerror(errno));
  return read_all(file.get(), path, content);
}

}  // namespace

std::string read_text(const std::string& path) { return read_path(path, Content::text); }

std::string read_regular(const std::string& path) {
  std::error_code error;
  if (std::filesystem::exists(path, error) && !std::filesystem::is_directory(path, error) &&
      !std::filesystem::is_regular_file(path, error))
    throw FileError(path + ": is not a regular file");
  return read_path(path, Content::any);
}

void write_text(const std::string& path, const std::string& text) { replace_file(path, {text}); }

std::string read_standard_input() { return read_all(stdin, "stdin", Content::text); }

}  // namespace slipfront::record
