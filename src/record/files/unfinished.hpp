#pragma once
/// \file
/// Where a result goes until it is whole.

#include <string>

namespace slipfront::record {

/// The output of a run. What stands there is not replaced before the run has reached its end: until then the result
/// goes to a file beside it, OUT.unfinished.nc.
class Output {
 public:
  Output() = default;  ///< none
  /// `path`: empty for none. `resumed_from`: what the run goes on from, if anything; writing there destroys nothing.
  /// \throws FileError if nothing can be written there, InputError if the file is not named as NetCDF.
  Output(std::string path, const std::string& resumed_from);

  bool wanted() const { return !path_.empty(); }
  bool replaces() const { return !unfinished_.empty(); }  ///< something stands there
  /// Where an unfinished result, and a finished one, is to be written.
  const std::string& unfinished() const { return unfinished_.empty() ? path_ : unfinished_; }
  const std::string& finished() const { return path_; }
  /// How to go on with an unfinished result: "--resume FILE".
  std::string how_to_resume() const;
  /// After the finished result has been written.
  void clear() const;

 private:
  std::string path_, unfinished_;
};

/// \throws InputError unless `path`, an `option` of a user, has a name that ends in .nc.
void require_netcdf_name(const std::string& path, const std::string& option);

/// \throws FileError if the disk of `path`, if that is not empty, has not as many free bytes.
void require_disk_space(const std::string& path, double bytes);

}  // namespace slipfront::record
