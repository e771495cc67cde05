// libFuzzer target: no bytes may crash the reader of checkpoints. Raw bytes test the seal. HDF5 itself does not
// tolerate hostile files. Behind the seal, the bytes therefore determine how a valid NetCDF file is made: which
// variables it lacks, and their types, shapes and values.

#include <fuzzer/FuzzedDataProvider.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>
#include <vector>

#include "runs/record/events/event_file.hpp"
#include "runs/record/netcdf/netcdf.hpp"
#include "runs/record/run_file.hpp"
#include "slipfront/error.hpp"
#include "system/files/whole_file.hpp"

namespace {

using slipfront::record::netcdf::Writer;

/// The path of a file in memory with these bytes.
const std::string& file_of(std::string_view bytes) {
  static const int descriptor = memfd_create("fuzz", MFD_CLOEXEC);
  static const std::string path = "/proc/self/fd/" + std::to_string(descriptor);
  if (descriptor < 0 || ftruncate(descriptor, 0) != 0 ||
      pwrite(descriptor, bytes.data(), bytes.size(), 0) != static_cast<ssize_t>(bytes.size()))
    std::abort();
  return path;
}

template <class Read>
void attempt(const Read& read) {
  try {
    read();
  } catch (const slipfront::FileError&) {
  } catch (const slipfront::InputError&) {
  }
}

void read(std::string_view bytes) {
  const std::string& path = file_of(bytes);
  attempt([&] { slipfront::record::read_checkpoint(path); });
  attempt([&] {
    slipfront::record::read_events_done(path, {.version = "1", .command_line = {}, .settings = {{"seed", "1"}}});
  });
}

std::string made(FuzzedDataProvider& data) {
  Writer file("fuzz");
  const auto usual = [&] { return data.ConsumeIntegralInRange(0, 15) != 0; };
  const auto text = [&](const char* name, const char* value) {
    if (usual())
      file.attribute(Writer::global, name, usual() ? std::string(value) : data.ConsumeRandomLengthString(40));
  };
  const bool events = data.ConsumeBool();
  text("slipfront_format", events ? slipfront::record::event_format : slipfront::record::pulse_format);
  if (events) text("seed", "1");
  text("scenario", "title = \"a\"");
  text("version", "1");
  if (usual()) file.attribute(Writer::global, "finished", usual() ? 1 : data.ConsumeIntegral<int>());
  const auto size = [&]() -> std::size_t { return data.ConsumeIntegralInRange<std::size_t>(0, usual() ? 5 : 500); };
  const std::vector<std::size_t> sizes = {size(), size(), size()};
  const std::vector<int> dimensions = {file.dimension("time", sizes[0]), file.dimension("x", sizes[1]),
                                       file.dimension("bytes", sizes[2])};
  std::vector<std::pair<int, std::size_t>> vectors;  // variables with one dimension, and its size
  std::vector<int> open_fields;                      // fields over an unlimited time dimension
  const auto add = [&](const std::string& name, std::vector<int> shape, bool bytes) {
    if (!usual()) return;
    if (!usual()) shape.push_back(dimensions[data.ConsumeIntegralInRange<std::size_t>(0, 2)]);
    if (!usual()) shape.pop_back();
    if (!usual()) bytes = !bytes;
    const int id = bytes ? file.bytes(name, shape) : file.reals(name, shape);
    if (!bytes && shape == std::vector<int>{dimensions[0], dimensions[1]} && sizes[0] == 0 && sizes[1] > 0)
      open_fields.push_back(id);
    for (std::size_t i = 0; i < dimensions.size(); ++i)
      if (!bytes && shape.size() == 1 && shape[0] == dimensions[i] && sizes[i] <= 5) vectors.emplace_back(id, sizes[i]);
  };
  add("time", {dimensions[0]}, false);
  add("x", {dimensions[1]}, false);
  for (const auto& field : slipfront::record::field_variables())
    add(std::string(field.about.name), {dimensions[0], dimensions[1]}, false);
  for (const auto& scalar : slipfront::output::scalars()) add(std::string(scalar.about.name), {dimensions[0]}, false);
  add("checkpoint", {dimensions[2]}, true);
  if (events) add("done", {dimensions[2]}, true);
  if (!usual()) add("scenario_text", {dimensions[2]}, true);
  file.end_definitions();
  for (const auto& [id, length] : vectors) {
    std::vector<double> values;
    for (std::size_t i = 0; i < length; ++i)
      values.push_back(usual() ? static_cast<double>(i) : data.ConsumeFloatingPoint<double>());
    file.write(id, values);
  }
  for (const int id : open_fields)  // rows far after the last one with data
    if (!usual()) file.write_row(id, data.ConsumeIntegral<std::size_t>() >> 8, std::vector<double>(sizes[1]));
  const auto image = file.finish();
  return std::string(image.bytes()) + slipfront::record::seal(image.bytes());
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  read({reinterpret_cast<const char*>(bytes), size});
  FuzzedDataProvider data(bytes, size);
  std::string file;
  try {
    file = made(data);
  } catch (const slipfront::FileError&) {  // the writer rejects this file
    return 0;
  }
  read(file);
  return 0;
}
