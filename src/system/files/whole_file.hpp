#pragma once
/// \file
/// Reads and writes whole files. A file is written completely or not at all. Also the output file of a run, and the
/// file that holds an unfinished result.

#include <functional>
#include <initializer_list>
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

}  // namespace slipfront::record
