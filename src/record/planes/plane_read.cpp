#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>

#include "foundation/bytes.hpp"
#include "record/files/seal.hpp"
#include "record/files/text_file.hpp"
#include "record/netcdf/netcdf_file.hpp"
#include "record/planes/plane_file.hpp"
#include "record/planes/plane_variables.hpp"
#include "slipfront/error.hpp"

namespace slipfront::record {
namespace {

using netcdf::Reader;
using netcdf::Variable;

[[noreturn]] void fail(const std::string& path, const std::string& reason) {
  throw FileError(path + ": not a file of a plane to resume from: " + reason);
}

Variable require(const std::string& path, const Reader& file, const std::string& name, std::size_t rank) {
  auto variable = file.find(name);
  if (!variable) fail(path, "variable " + name + " is missing");
  if (variable->shape.size() != rank) fail(path, name + " has the wrong shape");
  return *std::move(variable);
}

std::string text(const std::string& path, const Reader& file, const std::string& attribute) {
  auto value = file.text(attribute);
  if (!value) fail(path, "attribute " + attribute + " is missing");
  return *std::move(value);
}

/// The points of lines in a file, packed; no points if it has none.
void pack_lines(const std::string& path, const Reader& file, bytes::Writer& out) {
  std::optional<std::size_t> size;
  for (const PlaneLine& line : plane_lines()) {
    const auto variable = file.find(std::string(line.about.name));
    const std::vector<double> values = variable ? file.reals(*variable) : std::vector<double>{};
    if (size.value_or(values.size()) != values.size()) fail(path, "the points of lines have different sizes");
    size = values.size();
    out.put(values);
  }
}

/// Gives each snapshot its lines.
void unpack_lines(bytes::Reader& in, std::vector<plane::Field>& snapshots) {
  LinePoints points;
  for (const PlaneLine& line : plane_lines()) points.*line.values = in.vector();
  const std::size_t size = points.x.size();
  std::size_t i = 0;
  for (plane::Field& snapshot : snapshots)
    while (i < size && points.time[i] == snapshot.time) {
      plane::Line line{.number = static_cast<int>(points.number[i]), .points = {}};
      for (; i < size && !std::isnan(points.x[i]); ++i) line.points.push_back({points.x[i], points.y[i]});
      ++i;
      snapshot.lines.push_back(std::move(line));
    }
}

/// The content of a file, packed to be sent from the process that reads the file to this one.
std::string packed(const std::string& path, const Reader& file) {
  if (const std::string format = text(path, file, "slipfront_format"); format != plane_format)
    fail(path, "its slipfront_format is '" + format.substr(0, 40) + "'; this version reads '" + plane_format + "'");
  bytes::Writer out;
  out.put_text(file.bytes(require(path, file, "scenario_text", 1)));
  out.put_text(text(path, file, "version"));
  out.put_text(file.bytes(require(path, file, "checkpoint", 1)));
  out.put(file.number("finished") == 1.0);
  const std::vector<double> times = file.reals(require(path, file, "time", 1));
  const std::size_t nx = require(path, file, "x", 1).shape[0], ny = require(path, file, "y", 1).shape[0];
  out.put(times);
  out.put(static_cast<int>(nx));
  out.put(static_cast<int>(ny));
  std::vector<double> values(nx * ny);
  for (const PlaneField& field : plane_fields()) {
    const Variable variable = require(path, file, std::string(field.about.name), 3);
    if (variable.shape != std::vector<std::size_t>{times.size(), ny, nx})
      fail(path, variable.name + " has the wrong size");
    file.require_reals(variable);
    for (std::size_t row = 0; row < times.size(); ++row) {
      file.read_row(variable, row, values);
      out.put(values);
    }
  }
  pack_lines(path, file, out);
  return std::move(out).text();
}

PlaneCheckpoint unpacked(std::string_view content) {
  bytes::Reader in(content);
  PlaneCheckpoint run;
  for (std::string* text : {&run.scenario_text, &run.version, &run.run_state}) *text = in.text();
  run.finished = in.get<bool>();
  const std::vector<double> times = in.vector();
  const int nx = in.get<int>(), ny = in.get<int>();
  for (const double time : times)
    run.snapshots.push_back({.time = time, .nx = nx, .ny = ny, .slip = {}, .velocity = {}});
  for (const PlaneField& field : plane_fields())
    for (plane::Field& snapshot : run.snapshots) snapshot.*field.values = in.vector();
  unpack_lines(in, run.snapshots);
  return run;
}

}  // namespace

PlaneCheckpoint read_plane(const std::string& path) {
  const std::string file = read_regular(path);
  const std::string_view image = sealed_content(file, path);
  return unpacked(read_netcdf(path, image, image.size(), [&](const Reader& reader) { return packed(path, reader); }));
}

}  // namespace slipfront::record
