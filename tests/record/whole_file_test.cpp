// Files are written completely or not at all.

#include "system/files/whole_file.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/file.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>
#include <filesystem>
#include <functional>
#include <string>

#include "pulse_sample.hpp"
#include "runs/record/run_file.hpp"
#include "slipfront/error.hpp"
#include "temporary_folder.hpp"

namespace {

namespace fs = std::filesystem;

/// Called each time that the library has renamed a file.
std::function<void()> after_rename;

}  // namespace

/// Replaces the function of the system, also for the library.
extern "C" int rename(const char* from, const char* to) noexcept {
  const int result = renameat(AT_FDCWD, from, AT_FDCWD, to);
  if (result == 0 && after_rename) after_rename();
  return result;
}

namespace {

std::string failure(const std::string& path, std::size_t cells = 3) {
  const auto write = [&] { write_pulse(path, sample_metadata(), sample_snapshots(2, cells), "", false); };
  return message_of<slipfront::FileError>(write);
}

/// No file may become larger than `size`. This imitates a full disk.
class FileSizeLimit {
 public:
  explicit FileSizeLimit(rlim_t size) : old_handler_(signal(SIGXFSZ, SIG_IGN)) {
    getrlimit(RLIMIT_FSIZE, &old_);
    const rlimit limit{size, old_.rlim_max};
    setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~FileSizeLimit() {
    setrlimit(RLIMIT_FSIZE, &old_);
    signal(SIGXFSZ, old_handler_);
  }
  FileSizeLimit(const FileSizeLimit&) = delete;
  FileSizeLimit& operator=(const FileSizeLimit&) = delete;

 private:
  rlimit old_{};
  void (*old_handler_)(int);
};

/// Another thread may start a process while we write a file. That process inherits the descriptor and with it the lock.
TEST(WholeFile, LeavesNoLockToAProcessStartedDuringTheWrite) {
  const TemporaryFolder folder;
  const std::string path = folder / "a.txt";
  pid_t other = -1;
  slipfront::record::replace_file(path, [&](const slipfront::record::Put& put) {
    put("text");
    other = fork();
    if (other == 0) {
      pause();
      _exit(0);
    }
  });
  ASSERT_GT(other, 0);
  const int file = open(path.c_str(), O_RDONLY | O_CLOEXEC);
  EXPECT_EQ(flock(file, LOCK_EX | LOCK_NB), 0);
  close(file);
  kill(other, SIGKILL);
  waitpid(other, nullptr, 0);
}

/// HDF5 shares the lock of a file that it reads.
TEST(WholeFile, CanBeReadAsSoonAsItHasItsName) {
  const TemporaryFolder folder;
  const std::string path = folder / "a.txt";
  int readable = -1;
  after_rename = [&] {
    const int file = open(path.c_str(), O_RDONLY | O_CLOEXEC);
    readable = flock(file, LOCK_SH | LOCK_NB) == 0;
    close(file);
  };
  slipfront::record::replace_file(path, {"text"});
  after_rename = nullptr;
  EXPECT_EQ(readable, 1);
}

TEST(WholeFile, PreservesTheOldFileIfAWriteFails) {
  const TemporaryFolder folder;
  const std::string path = folder / "a.nc";
  ASSERT_EQ(failure(path), "");
  const std::string old = read_bytes(path);
  {
    const FileSizeLimit limit(4096);
    EXPECT_EQ(failure(path, 100), path + ": cannot be written: File too large");
  }
  EXPECT_EQ(read_bytes(path), old);
  EXPECT_EQ(folder.files(), 1u);
  EXPECT_EQ(failure(path, 100), "");
  EXPECT_NE(read_bytes(path), old);
  EXPECT_EQ(folder.files(), 1u);
}

TEST(WholeFile, NamesWrongPaths) {
  const TemporaryFolder folder;
  EXPECT_EQ(failure(folder / "none/a.nc"),
            (folder / "none/a.nc") + ": cannot be written: folder " + (folder / "none") + " does not exist");
  EXPECT_EQ(failure(folder.path().string()), folder.path().string() + ": cannot be written: is a directory");
  EXPECT_NE(failure(folder / std::string(300, 'a')).find("File name too long"), std::string::npos);
  EXPECT_EQ(failure(""), "the name of the output file is empty");
  write_bytes(folder / "file", "");
  EXPECT_NE(failure(folder / "file/a.nc").find("Not a directory"), std::string::npos);
  EXPECT_EQ(folder.files(), 1u);
}

TEST(WholeFile, ReplacesNoDevices) {
  const TemporaryFolder folder;
  ASSERT_EQ(mkfifo((folder / "pipe").c_str(), 0600), 0);
  EXPECT_EQ(failure(folder / "pipe"), (folder / "pipe") + ": cannot be written: is not a regular file");
  EXPECT_TRUE(fs::is_fifo(folder / "pipe"));
}

TEST(WholeFile, FollowsLinksAndPreservesModes) {
  const TemporaryFolder folder;
  fs::create_directory(folder / "deep");
  fs::create_symlink("deep/target.nc", folder / "link.nc");
  ASSERT_EQ(failure(folder / "link.nc"), "");
  EXPECT_TRUE(fs::is_symlink(folder / "link.nc"));
  fs::permissions(folder / "deep/target.nc", fs::perms::owner_read | fs::perms::owner_write);
  ASSERT_EQ(failure(folder / "link.nc"), "");
  EXPECT_EQ(fs::status(folder / "deep/target.nc").permissions(), fs::perms::owner_read | fs::perms::owner_write);
}

TEST(WholeFile, UsesNamesLiterallyThatTheNetcdfLibraryWouldInterpret) {
  const TemporaryFolder folder;
  for (const char* name : {" a b.nc", "a#mode=zarr", "s3:a.nc", "a\\b.nc", "a%20.nc", "[x=1]a.nc", "\xff.nc"}) {
    EXPECT_EQ(failure(folder / name), "") << name;
    EXPECT_EQ(slipfront::record::read_checkpoint(folder / name).snapshots.size(), 2u) << name;
  }
  EXPECT_EQ(folder.files(), 7u);
}

}  // namespace
