#include "record/files/unfinished.hpp"

#include <unistd.h>

#include <filesystem>
#include <system_error>
#include <utility>

#include "foundation/text/digits.hpp"
#include "record/files/whole_file.hpp"
#include "slipfront/error.hpp"

namespace slipfront::record {

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

}  // namespace slipfront::record
