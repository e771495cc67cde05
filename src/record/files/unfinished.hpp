#pragma once
/// \file
/// The output file of a run, and the file that holds an unfinished result.

#include <string>
#include <vector>

namespace slipfront::record {

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
