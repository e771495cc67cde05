#include <cmath>
#include <cstddef>
#include <utility>

#include "record/files/seal.hpp"
#include "record/files/text_file.hpp"
#include "record/netcdf/netcdf.hpp"
#include "record/planes/plane_file.hpp"
#include "slipfront/error.hpp"
#include "slipfront/plane/quantities.hpp"

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

plane::LinePoints points_of_lines(const std::string& path, const Reader& file) {
  plane::LinePoints points;
  for (const plane::LineArray& line : plane::line_arrays())
    if (const auto variable = file.find(std::string(line.about.name))) points.*line.values = file.reals(*variable);
  for (const plane::LineArray& line : plane::line_arrays())
    if ((points.*line.values).size() != points.x.size()) fail(path, "the points of lines have different sizes");
  return points;
}

/// Gives each snapshot its lines.
void add_lines(const plane::LinePoints& points, std::vector<plane::Field>& snapshots) {
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

PlaneCheckpoint read_file(const std::string& path, const Reader& file) {
  if (const std::string format = text(path, file, "slipfront_format"); format != plane_format)
    fail(path, "its slipfront_format is '" + format.substr(0, 40) + "'; this version reads '" + plane_format + "'");
  PlaneCheckpoint run;
  run.scenario_text = file.bytes(require(path, file, "scenario_text", 1));
  run.version = text(path, file, "version");
  run.run_state = file.bytes(require(path, file, "checkpoint", 1));
  run.finished = file.number("finished") == 1.0;
  const std::vector<double> times = file.reals(require(path, file, "time", 1));
  const std::size_t nx = require(path, file, "x", 1).shape[0], ny = require(path, file, "y", 1).shape[0];
  for (const double time : times)
    run.snapshots.push_back(
        {.time = time, .nx = static_cast<int>(nx), .ny = static_cast<int>(ny), .slip = {}, .velocity = {}});
  for (const plane::FieldArray& field : plane::field_arrays()) {
    const Variable variable = require(path, file, std::string(field.about.name), 3);
    if (variable.shape != std::vector<std::size_t>{times.size(), ny, nx})
      fail(path, variable.name + " has the wrong size");
    file.require_reals(variable);
    for (std::size_t row = 0; row < times.size(); ++row) {
      std::vector<double>& values = run.snapshots[row].*field.values;
      values.resize(nx * ny);
      file.read_row(variable, row, values);
    }
  }
  add_lines(points_of_lines(path, file), run.snapshots);
  return run;
}

}  // namespace

PlaneCheckpoint read_plane(const std::string& path) {
  const std::string file = read_regular(path);
  const std::string_view image = sealed_content(file, path);
  return read_file(path, Reader(path, image, image.size()));
}

}  // namespace slipfront::record
