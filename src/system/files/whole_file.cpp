#include "system/files/whole_file.hpp"

#include <dirent.h>
#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <charconv>
#include <chrono>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <system_error>
#include <thread>
#include <utility>

#include "math/digits.hpp"
#include "slipfront/error.hpp"
#include "system/machine.hpp"

namespace slipfront::record {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(const std::string& path, const std::string& reason) {
  throw FileError(path + ": cannot be written: " + reason);
}

std::string reason(int error) { return std::generic_category().message(error); }

/// Follows symbolic links from `path` to the target, which need not exist.
fs::path behind_links(const std::string& path) {
  fs::path target(path);
  std::error_code error;
  for (int i = 0; i < 40; ++i) {  // the system follows 40 links at most
    const fs::path next = fs::read_symlink(target, error);
    if (error) return target;  // not a link, or no such file
    // A link in /proc leads to an open file. A new file of the same name would be a different file.
    const std::string folder = fs::canonical(target.has_parent_path() ? target.parent_path() : ".", error).string();
    if (folder.rfind("/proc/", 0) == 0) fail(path, "links to an open file, not to a file name");
    target = target.parent_path() / next;
  }
  fail(path, reason(ELOOP));
}

bool all_digits(std::string_view text) {
  return !text.empty() && text.find_first_not_of("0123456789") == std::string_view::npos;
}

/// The process in `name`, if PartFile uses this name for `target`.
std::optional<pid_t> writer_of(std::string_view name, const std::string& target) {
  const std::string begin = target + ".part";
  if (name.substr(0, begin.size()) != begin) return {};
  name.remove_prefix(begin.size());
  const std::size_t dash = name.find('-');
  if (dash == std::string_view::npos || !all_digits(name.substr(0, dash)) || !all_digits(name.substr(dash + 1)))
    return {};
  pid_t process = 0;
  const auto [end, error] = std::from_chars(name.data(), name.data() + dash, process);
  return error == std::errc() ? std::optional(process) : std::nullopt;
}

/// Unlocks and closes a file. Without the explicit unlock, a process that was started meanwhile would keep the lock.
int close_unlocked(int descriptor) {
  flock(descriptor, LOCK_UN);
  return close(descriptor);
}

/// Locks a part file of the process `writer`, unless another process holds the lock. A process that was killed can
/// leave the lock to a fork that draws (`_files.isolated` in Python) and ends a moment later, so we wait for it.
bool lock_part(int part, pid_t writer) {
  for (int tries = 0;; ++tries) {
    if (flock(part, LOCK_EX | LOCK_NB) == 0) return true;
    const bool ended = kill(writer, 0) != 0 && errno == ESRCH;
    if (!ended || tries == 50) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
}

/// Removes the part files of `target` that no process has locked. A process looks only once for each target, because a
/// folder may be large. A file that cannot be removed is not an error.
void remove_parts(const fs::path& target) {
  static std::mutex mutex;
  static std::set<fs::path> looked_at;
  const std::scoped_lock lock(mutex);
  if (looked_at.size() > 1000 || !looked_at.insert(fs::absolute(target)).second) return;
  const fs::path folder = target.has_parent_path() ? target.parent_path() : ".";
  // We avoid the iterators of std::filesystem, which end the program if memory runs out.
  const std::unique_ptr<DIR, int (*)(DIR*)> entries(opendir(folder.c_str()), closedir);
  while (const dirent* entry = entries ? readdir(entries.get()) : nullptr) {
    const std::optional<pid_t> writer = writer_of(entry->d_name, target.filename().string());
    if (!writer || *writer <= 0) continue;
    const int part = openat(dirfd(entries.get()), entry->d_name, O_WRONLY | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK);
    if (part < 0) continue;
    if (lock_part(part, *writer)) unlinkat(dirfd(entries.get()), entry->d_name, 0);
    close_unlocked(part);
  }
}

/// A new file in the folder of `target`. It is locked while it is written, and is removed unless it was renamed.
class PartFile {
 public:
  PartFile(const std::string& path, const std::string& target) : path_(path) {
    static std::atomic<unsigned> made = 0;  // two threads of one process may write at once
    for (;;) {
      name_ = target + ".part" + std::to_string(getpid()) + "-" + std::to_string(made++);
      descriptor_ = open(name_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
      if (descriptor_ < 0 && (errno == EEXIST || errno == EINTR)) continue;  // EEXIST: from a process that was killed
      if (descriptor_ < 0) fail(path_, reason(errno));
      struct stat now {};
      const bool locked =
          flock(descriptor_, LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK;  // some file systems have no locks
      if (locked && fstat(descriptor_, &now) == 0 && now.st_nlink > 0) return;
      close_unlocked(descriptor_);  // another process removed it before it was locked
    }
  }
  ~PartFile() {
    if (!name_.empty()) unlink(name_.c_str());
    if (descriptor_ >= 0) close_unlocked(descriptor_);
  }
  PartFile(const PartFile&) = delete;
  PartFile& operator=(const PartFile&) = delete;

  void set_mode(mode_t mode) {
    if (fchmod(descriptor_, mode) != 0) fail(path_, reason(errno));
  }

  void write(std::string_view data) {
    constexpr std::size_t most = std::size_t{1} << 30;  // the system accepts no more in one call
    while (!data.empty()) {
      const ssize_t size = ::write(descriptor_, data.data(), std::min(data.size(), most));
      if (size < 0 && errno == EINTR) continue;
      if (size <= 0) fail(path_, reason(size < 0 ? errno : ENOSPC));
      data.remove_prefix(static_cast<std::size_t>(size));
    }
  }

  void rename_to(const std::string& target) {
    if (fsync(descriptor_) != 0) fail(path_, reason(errno));
    const int lock = dup(descriptor_);  // holds the lock until the file has its new name
    const int descriptor = std::exchange(descriptor_, -1);
    const bool closed = close(descriptor) == 0;
    const int why = errno;
    // HDF5 shares a lock of a file that it reads, so that it could not open one with an exclusive lock. A shared lock
    // still keeps remove_parts away.
    if (lock >= 0) flock(lock, LOCK_SH);
    const bool renamed = closed && std::rename(name_.c_str(), target.c_str()) == 0;
    const int why_not_renamed = errno;
    if (lock >= 0) close_unlocked(lock);
    if (!closed) fail(path_, reason(why));
    if (!renamed) fail(path_, reason(why_not_renamed));
    name_.clear();
  }

 private:
  const std::string& path_;  ///< as the user named it, for messages
  std::string name_;
  int descriptor_ = -1;
};

/// Writes the new name to the disk too. Not every file system can do this, so errors are ignored. The content is on the
/// disk already.
void sync_folder(const fs::path& folder) {
  const int descriptor = open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor < 0) return;
  fsync(descriptor);
  close(descriptor);
}

std::atomic<int> writing = 0;
static_assert(std::atomic<int>::is_always_lock_free);

struct Counted {
  Counted() { ++writing; }
  ~Counted() { --writing; }
  Counted(const Counted&) = delete;
  Counted& operator=(const Counted&) = delete;
};

/// The file to which `path` leads, its folder, and whether the file exists.
struct Place {
  fs::path target, folder;
  bool replaces = false;
  mode_t mode = 0;
};

Place place_of(const std::string& path) {
  if (path.empty()) throw FileError("the name of the output file is empty");
  if (path.find('\0') != std::string::npos) throw FileError("the name of the output file contains a zero byte");
  Place place{behind_links(path), {}};
  place.folder = place.target.parent_path();
  if (place.folder.empty()) place.folder = ".";
  std::error_code error;
  if (!fs::exists(place.folder, error))
    fail(path, error ? error.message() : "folder " + place.folder.string() + " does not exist");

  struct stat old {};
  place.replaces = stat(place.target.c_str(), &old) == 0;
  place.mode = old.st_mode;
  if (place.replaces && S_ISDIR(old.st_mode)) fail(path, "is a directory");
  // Renaming over /dev/null would replace the device for everyone.
  if (place.replaces && !S_ISREG(old.st_mode)) fail(path, "is not a regular file");
  // Renaming needs only the permission to change the folder, but we must not replace a write-protected file.
  if (place.replaces && access(place.target.c_str(), W_OK) != 0) fail(path, reason(errno));
  return place;
}

}  // namespace

void require_replaceable(const std::string& path) {
  const Place place = place_of(path);
  if (access(place.folder.c_str(), W_OK | X_OK) != 0) fail(path, reason(errno));
}

void remove_leftovers(const std::string& path) { remove_parts(place_of(path).target); }

bool is_writing() noexcept { return writing > 0; }

void replace_file(const std::string& path, const std::function<void(const Put&)>& write) {
  const Counted counted;
  const Place place = place_of(path);
  remove_parts(place.target);
  PartFile part(path, place.target.string());
  if (place.replaces) part.set_mode(place.mode & 07777);
  write([&](std::string_view data) { part.write(data); });
  part.rename_to(place.target.string());
  sync_folder(place.folder);
}

void replace_file(const std::string& path, std::initializer_list<std::string_view> parts) {
  replace_file(path, [&](const Put& put) {
    for (const std::string_view data : parts) put(data);
  });
}

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

namespace fs = std::filesystem;

Output::Output(std::string path, const std::string& resumed_from) : path_(std::move(path)) {
  if (path_.empty()) return;
  require_replaceable(path_);
  fs::path beside(path_);
  beside.replace_extension(".unfinished.nc");
  remove_leftovers(beside.string());  // this run may write no such file itself
  std::error_code none;
  if (!fs::exists(path_, none) || fs::equivalent(path_, resumed_from, none)) return;
  unfinished_ = beside.string();
  require_replaceable(unfinished_);
}

std::string Output::how_to_resume() const {
  return "--resume " + unfinished() + (unfinished_.empty() ? "" : " -o " + path_);
}

void Output::clear() const {
  if (!unfinished_.empty()) unlink(unfinished_.c_str());
}

void require_netcdf_name(const std::string& path, const std::string& option) {
  if (fs::path(path).extension() == ".nc") return;
  throw InputError({.file = "command line",
                    .key = option,
                    .value = path,
                    .problem = path.empty() ? "the file name is empty" : "unsupported file type",
                    .allowed = "a name that ends in .nc"});
}

void require_other_file(const std::string& output, const std::vector<std::string>& inputs) {
  for (const std::string& input : inputs) {
    std::error_code not_there;
    if (output.empty() || input.empty() || !fs::equivalent(input, output, not_there)) continue;
    throw InputError({.file = "command line",
                      .key = "-o",
                      .value = output,
                      .problem = "is the input file " + input + ", which it would replace",
                      .allowed = "a file other than those read"});
  }
}

void require_disk_space(const std::string& path, double bytes) {
  if (path.empty()) return;
  std::error_code unknown;
  fs::path folder = fs::path(path).parent_path();
  const fs::space_info space = fs::space(folder.empty() ? "." : folder, unknown);
  if (unknown || static_cast<double>(space.available) >= bytes) return;
  throw FileError(path + ": the file needs " + digits(bytes / 1e9, 3) + " GB, the disk has " +
                  digits(static_cast<double>(space.available) / 1e9, 3) + " GB free");
}

namespace {

constexpr std::string_view magic = "SLIPSEAL";
constexpr std::size_t seal_size = 24;

void append(std::string& text, std::uint64_t value) {
  for (int shift = 0; shift < 64; shift += 8) text += static_cast<char>(static_cast<unsigned char>(value >> shift));
}

}  // namespace

std::string seal(std::string_view content) {
  std::string text(magic);
  append(text, content.size());
  append(text, Fnv().bytes(content).sum());
  return text;
}

std::string_view without_broken_seal(std::string_view file, const std::string& name) {
  const bool sealed = file.size() >= seal_size && file.substr(file.size() - seal_size, magic.size()) == magic;
  return sealed ? sealed_content(file, name) : file;
}

void require_unbroken_seal(const std::string& path) { without_broken_seal(read_regular(path), path); }

std::string_view sealed_content(std::string_view file, const std::string& name) {
  if (file.empty()) throw FileError(name + ": the file is empty");
  if (file.substr(0, 8) != "\x89HDF\r\n\x1a\n") throw FileError(name + ": not a NetCDF-4 file");
  if (file.size() < seal_size || file.substr(file.size() - seal_size, magic.size()) != magic)
    throw FileError(name + ": has no seal at its end: not written by slipfront, or cut short or changed since");
  const std::string_view content = file.substr(0, file.size() - seal_size);
  if (file.substr(content.size()) != seal(content)) throw FileError(name + ": damaged: the checksum does not match");
  return content;
}

}  // namespace slipfront::record
