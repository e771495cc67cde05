#include "netcdf_file.hpp"

#include "isolated.hpp"
#include "seal.hpp"
#include "whole_file.hpp"

namespace slipfront::record {

void write_netcdf(const std::string& path, std::size_t expected_size,
                  const std::function<void(netcdf::Writer&)>& fill) {
  replace_file(path, [&](const Put& put) {
    isolated(path, "cannot be written", [&]() -> std::string {
      netcdf::Writer file(path, expected_size);
      fill(file);
      const netcdf::Image image = file.finish();
      put(image.bytes());
      put(seal(image.bytes()));
      return {};
    });
  });
}

std::string read_netcdf(const std::string& path, std::string_view image, std::size_t most_bytes,
                        const std::function<std::string(const netcdf::Reader&)>& take) {
  return isolated(path, "cannot be read", [&] { return take(netcdf::Reader(path, image, most_bytes)); });
}

}  // namespace slipfront::record
