#include "page_folder.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "slipfront/error.hpp"

Descriptor::~Descriptor() {
  if (number_ >= 0) close(number_);
}

PageFolder::PageFolder(const std::string& path) : folder_(::open(path.c_str(), O_PATH | O_DIRECTORY | O_CLOEXEC)) {
  if (!folder_) throw slipfront::FileError(path + ": cannot be opened: " + std::strerror(errno));
}

PageFile PageFolder::open(const std::vector<std::string>& names) const {
  Descriptor folder;
  for (std::size_t i = 0; i < names.size(); ++i) {
    const bool is_file = i + 1 == names.size();
    // O_NONBLOCK: a named pipe must not make the server wait for a writer.
    const int mode = is_file ? O_RDONLY | O_NONBLOCK : O_PATH | O_DIRECTORY;
    const int within = folder ? folder.get() : folder_.get();
    Descriptor next(openat(within, names[i].c_str(), mode | O_NOFOLLOW | O_NOCTTY | O_CLOEXEC));
    if (!next) return {};
    folder = std::move(next);
  }
  struct stat status {};
  if (!folder || fstat(folder.get(), &status) != 0 || !S_ISREG(status.st_mode)) return {};
  return {.descriptor = std::move(folder), .size = status.st_size};
}
