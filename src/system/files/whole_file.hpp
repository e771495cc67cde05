#pragma once
/// \file
/// Reads and writes whole files. A file is written completely or not at all. Also the output file of a run, and the
/// file that holds an unfinished result.
///
/// A seal at the end of a file is a magic number, and the length and checksum of all bytes before it. HDF5 ignores
/// bytes after its own, so every NetCDF reader can still open the file. The NetCDF library trusts the bytes that it
/// reads. The seal lets us reject a file that was truncated, damaged or changed before the library sees it.

#include <bit>
#include <cstdint>
#include <cstring>
#include <functional>
#include <initializer_list>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace slipfront::record {

/// Appends to the file that is being written. \throws FileError.
using Put = std::function<void(std::string_view)>;

/// Replaces `path` by the file that `write` produces. The new file is written in the same folder, flushed to the disk
/// and then renamed. A reader of `path` finds either the old file or the new one, and a failure leaves the old file
/// unchanged. Links are followed. Part files of killed processes are removed. \throws FileError with path and reason.
void replace_file(const std::string& path, const std::function<void(const Put&)>& write);

/// Like the function above, for a file that consists of `parts`, one after the other.
void replace_file(const std::string& path, std::initializer_list<std::string_view> parts);

/// Checks whether replace_file could replace `path`, as far as that is known without writing. \throws FileError if not.
void require_replaceable(const std::string& path);

/// Removes the part files that killed processes left for `path`, like replace_file. \throws FileError like
/// require_replaceable.
void remove_leftovers(const std::string& path);

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

/// The output of a run. An existing output file is not replaced before the run has reached its end. Until then, the
/// result goes to OUT.unfinished.nc in the same folder.
class Output {
 public:
  Output() = default;  ///< no output
  /// An empty `path` means no output. `resumed_from` is the file from which the run resumes, or empty; the run may
  /// write over it, because nothing is lost. \throws FileError if `path` cannot be written.
  Output(std::string path, const std::string& resumed_from);

  bool wanted() const { return !path_.empty(); }
  bool replaces() const { return !unfinished_.empty(); }  ///< the output file exists already
  /// The file for an unfinished result, and the file for a finished one.
  const std::string& unfinished() const { return unfinished_.empty() ? path_ : unfinished_; }
  const std::string& finished() const { return path_; }
  /// The option that resumes an unfinished result: "--resume FILE".
  std::string how_to_resume() const;
  /// Removes the unfinished result. Call it after the finished result has been written.
  void clear() const;

 private:
  std::string path_, unfinished_;
};

/// \throws InputError unless the name `path` ends in .nc. The user gave it with `option`.
void require_netcdf_name(const std::string& path, const std::string& option);

/// \throws InputError if writing `output` would destroy one of the files that a command reads: the same file, under the
/// same name, another spelling or a link. Empty names are no files.
void require_other_file(const std::string& output, const std::vector<std::string>& inputs);

/// \throws FileError if the disk of `path` has fewer than `bytes` free bytes. Does nothing if `path` is empty.
void require_disk_space(const std::string& path, double bytes);

/// FNV-1a, 64 bits. Each step is a bijection of the sum: one changed byte always changes the result. It finds damage,
/// not malice.
class Fnv {
 public:
  Fnv& bytes(std::string_view data) {
    for (const char c : data) byte(static_cast<unsigned char>(c));
    return *this;
  }
  /// Eight bytes at a time: another sum than that of `bytes`, eight times as fast.
  Fnv& words(std::string_view data) {
    for (; data.size() >= sizeof(std::uint64_t); data.remove_prefix(sizeof(std::uint64_t))) {
      std::uint64_t word = 0;
      std::memcpy(&word, data.data(), sizeof word);
      sum_ = (sum_ ^ word) * 0x100000001b3ULL;
    }
    return bytes(data);
  }
  /// Least significant byte first, on every machine.
  Fnv& number(std::uint64_t value) {
    for (int shift = 0; shift < 64; shift += 8) byte(static_cast<unsigned char>(value >> shift));
    return *this;
  }
  /// With its length, so that two texts in a row cannot be told apart wrongly.
  Fnv& text(std::string_view data) { return number(data.size()).bytes(data); }
  Fnv& real(double value) { return number(std::bit_cast<std::uint64_t>(value)); }
  Fnv& reals(std::span<const double> values) {
    number(values.size());
    for (const double value : values) real(value);
    return *this;
  }
  std::uint64_t sum() const { return sum_; }

 private:
  void byte(unsigned char value) { sum_ = (sum_ ^ value) * 0x100000001b3ULL; }
  std::uint64_t sum_ = 0xcbf29ce484222325ULL;
};

/// Returns the seal to append to `content`.
std::string seal(std::string_view content);

/// Returns the content before the seal. \throws FileError with `name` if the seal is missing or broken.
std::string_view sealed_content(std::string_view file, const std::string& name);

/// Like `sealed_content`, but for files that other programs may have written. A file without a seal is accepted whole.
std::string_view without_broken_seal(std::string_view file, const std::string& name);

/// Checks the seal of the file `path`, if it has one. \throws FileError if the file cannot be read or was changed.
void require_unbroken_seal(const std::string& path);

}  // namespace slipfront::record
