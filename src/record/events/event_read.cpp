#include "record/events/event_file.hpp"
#include "record/events/event_layout.hpp"
#include "record/files/seal.hpp"
#include "record/files/text_file.hpp"
#include "record/netcdf/netcdf.hpp"
#include "slipfront/error.hpp"

namespace slipfront::record {

namespace {

std::string done_in(const netcdf::Reader& file, const std::string& path, const EventMetadata& metadata) {
  const auto fail = [&](const std::string& reason) {
    throw FileError(path + ": not a catalogue to resume from: " + reason);
  };
  const std::string format = file.text("slipfront_format").value_or("");
  if (format != event_format)
    fail("its slipfront_format is '" + format.substr(0, 40) + "'; this version reads '" + event_format + "'");
  const auto require = [&](const std::string& name, const std::string& wanted) {
    const auto written = file.text(name);
    if (!written) fail("attribute " + name + " is missing");
    if (*written == clean_text(wanted, netcdf::longest_text)) return;
    throw InputError({.file = path,
                      .key = "resume",
                      .value = *written,
                      .problem = name == "input_checksum" ? "was written from other files or contents"
                                                          : "was written with another " + name,
                      .allowed = "go on as it was begun, here it is '" + wanted + "'"});
  };
  require("version", metadata.version);
  for (const auto& [name, text] : metadata.settings) require(name, text);
  const auto done = file.find(event_layout::state);
  if (!done || done->shape.size() != 1) fail(std::string("variable ") + event_layout::state + " is missing");
  return file.bytes(*done);
}

}  // namespace

std::string read_events_done(const std::string& path, const EventMetadata& metadata) {
  const std::string content = read_regular(path);
  const std::string_view image = sealed_content(content, path);
  return done_in(netcdf::Reader(path, image, image.size()), path, metadata);
}

}  // namespace slipfront::record
