#include "record/netcdf/netcdf_file.hpp"

#include <new>

#include "record/files/seal.hpp"
#include "record/files/whole_file.hpp"
#include "record/netcdf/isolated.hpp"

namespace slipfront::record {

void write_netcdf(const std::string& path, std::size_t expected_size,
                  const std::function<void(netcdf::Writer&)>& fill) {
  replace_file(path, [&](const Put& put) {
    isolated(path, "cannot be written", [&]() -> std::string {
      const auto sealed = [&](const Put& put_image) {
        netcdf::Writer file(path, expected_size);
        fill(file);
        const netcdf::Image image = file.finish();
        put_image(image.bytes());
        return seal(image.bytes());
      };
      // HDF5 can drop data silently when memory runs out. We write the file twice and accept it only if both copies are
      // identical.
      const std::string rehearsal = sealed([](std::string_view) {});
      const std::string end = sealed(put);
      if (end != rehearsal) throw std::bad_alloc();
      put(end);
      return {};
    });
  });
}

std::string read_netcdf(const std::string& path, std::string_view image, std::size_t most_bytes,
                        const std::function<std::string(const netcdf::Reader&)>& take) {
  // A damaged file can make the library read endlessly. Normally it reads 100 MB a second.
  const unsigned long seconds = 30 + image.size() / 1000000;
  return isolated(
      path, "cannot be read", [&] { return take(netcdf::Reader(path, image, most_bytes)); }, seconds);
}

}  // namespace slipfront::record
