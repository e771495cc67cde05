#include "whole_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <system_error>

#include "slipfront/error.hpp"

namespace slipfront::record {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(const std::string& path, const std::string& reason) {
  throw FileError(path + ": cannot be written: " + reason);
}

std::string reason(int error) { return std::generic_category().message(error); }

/// Where a link points to, be there a file or not.
fs::path behind_links(const std::string& path) {
  fs::path target(path);
  std::error_code error;
  for (int i = 0; i < 40; ++i) {  // as many as the system follows
    const fs::path next = fs::read_symlink(target, error);
    if (error) return target;  // no link, or nothing at all
    target = target.parent_path() / next;
  }
  fail(path, reason(ELOOP));
}

/// A new file beside `target`; gone again unless it was renamed.
class PartFile {
 public:
  PartFile(const std::string& path, const std::string& target) : path_(path) {
    static std::atomic<unsigned> made = 0;  // two threads of one process may write at once
    do {
      name_ = target + ".part" + std::to_string(getpid()) + "-" + std::to_string(made++);
      descriptor_ = open(name_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    } while (descriptor_ < 0 &&
             (errno == EEXIST || errno == EINTR));  // EEXIST: left by a killed process of this number
    if (descriptor_ < 0) fail(path_, reason(errno));
  }
  ~PartFile() {
    if (descriptor_ >= 0) close(descriptor_);
    if (!name_.empty()) unlink(name_.c_str());
  }
  PartFile(const PartFile&) = delete;
  PartFile& operator=(const PartFile&) = delete;

  void set_mode(mode_t mode) {
    if (fchmod(descriptor_, mode) != 0) fail(path_, reason(errno));
  }

  void write(std::string_view data) {
    constexpr std::size_t most = std::size_t{1} << 30;  // the system takes no more at once
    while (!data.empty()) {
      const ssize_t size = ::write(descriptor_, data.data(), std::min(data.size(), most));
      if (size < 0 && errno == EINTR) continue;
      if (size <= 0) fail(path_, reason(size < 0 ? errno : ENOSPC));
      data.remove_prefix(static_cast<std::size_t>(size));
    }
  }

  void rename_to(const std::string& target) {
    if (fsync(descriptor_) != 0) fail(path_, reason(errno));
    const int descriptor = descriptor_;
    descriptor_ = -1;
    if (close(descriptor) != 0) fail(path_, reason(errno));
    if (std::rename(name_.c_str(), target.c_str()) != 0) fail(path_, reason(errno));
    name_.clear();
  }

 private:
  const std::string& path_;  ///< as the user named it, for messages
  std::string name_;
  int descriptor_ = -1;
};

/// Brings the new name to the disk too. Not every file system can; the file itself is safe already.
void sync_folder(const fs::path& folder) {
  const int descriptor = open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor < 0) return;
  fsync(descriptor);
  close(descriptor);
}

}  // namespace

void replace_file(const std::string& path, std::initializer_list<std::string_view> parts) {
  if (path.empty()) throw FileError("cannot write a file without a name");
  if (path.find('\0') != std::string::npos) throw FileError("cannot write a file with a zero byte in its name");
  const fs::path target = behind_links(path);
  fs::path folder = target.parent_path();
  if (folder.empty()) folder = ".";
  std::error_code error;
  if (!fs::exists(folder, error)) fail(path, error ? error.message() : "folder " + folder.string() + " does not exist");

  struct stat old {};
  const bool replaces = stat(target.c_str(), &old) == 0;
  if (replaces && S_ISDIR(old.st_mode)) fail(path, "is a directory");
  // Renaming over /dev/null would replace the device for everyone.
  if (replaces && !S_ISREG(old.st_mode)) fail(path, "is not a regular file");
  // Renaming asks for the right to change the folder only; a file that is write-protected shall stay so.
  if (replaces && access(target.c_str(), W_OK) != 0) fail(path, reason(errno));

  PartFile part(path, target.string());
  if (replaces) part.set_mode(old.st_mode & 07777);
  for (const std::string_view data : parts) part.write(data);
  part.rename_to(target.string());
  sync_folder(folder);
}

}  // namespace slipfront::record
