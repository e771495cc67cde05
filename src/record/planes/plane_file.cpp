#include "record/planes/plane_file.hpp"

#include <cmath>
#include <cstddef>
#include <span>
#include <utility>

#include "foundation/math/constants.hpp"
#include "record/netcdf/netcdf.hpp"
#include "record/pulses/cf.hpp"
#include "slipfront/plane/quantities.hpp"
#include "slipfront/plane/source_parameters.hpp"

namespace slipfront::record {
namespace {

using netcdf::Writer;

struct Dimensions {
  int time, y, x, series, frequency;
};

/// Centres of the cells between two ends.
std::vector<double> centres(double from, double to, int cells) {
  std::vector<double> all;
  all.reserve(static_cast<std::size_t>(cells));
  for (int i = 0; i < cells; ++i) all.push_back(from + (to - from) * (i + 0.5) / cells);
  return all;
}

int opaque(Writer& file, const char* name, const char* long_name, std::size_t size) {
  const int variable = file.bytes(name, {file.dimension(std::string(name) + "_bytes", size)});
  file.attribute(variable, "long_name", long_name);
  file.attribute(variable, "units", "1");
  return variable;
}

/// Variables with the values that `write` gives them after all are defined.
class PlaneWriter {
 public:
  PlaneWriter(Writer& file, const PulseMetadata& metadata, const PlaneGrid& grid, const plane::Run& run,
              const std::string& state)
      : file_(file),
        metadata_(metadata),
        grid_(grid),
        run_(run),
        state_(state),
        frequencies_(plane::spectrum_frequencies(run.series())) {
    dimensions_.time = file.dimension("time", run.snapshots().size());
    dimensions_.y = file.dimension("y", static_cast<std::size_t>(grid.ny));
    dimensions_.x = file.dimension("x", static_cast<std::size_t>(grid.nx));
    dimensions_.series = file.dimension("series_time", run.series().size());
    dimensions_.frequency = file.dimension("frequency", frequencies_.size());
  }

  void define() {
    if (run_.schedule().lines) define_lines();
    time_ = cf::reals(file_, plane::time_axis, {dimensions_.time}, metadata_);
    y_ = cf::reals(file_, plane::y_axis, {dimensions_.y}, metadata_);
    x_ = cf::reals(file_, plane::x_axis, {dimensions_.x}, metadata_);
    file_.attribute(y_, "axis", "Y");
    file_.attribute(x_, "axis", "X");
    for (const plane::FieldArray& field : plane::field_arrays())
      fields_.push_back(cf::reals(file_, field.about, {dimensions_.time, dimensions_.y, dimensions_.x}, metadata_));
    for (const plane::MapArray& map : plane::map_arrays()) {
      maps_.push_back(
          cf::reals(file_, description_of(map, run_.schedule()), {dimensions_.y, dimensions_.x}, metadata_));
      file_.fill_value(maps_.back(), none);
    }
    for (const plane::SeriesNumber& series : plane::series_numbers())
      series_.push_back(cf::reals(file_, series.about, {dimensions_.series}, metadata_));
    frequency_ = cf::reals(file_, plane::frequency_axis, {dimensions_.frequency}, metadata_);
    spectrum_ = cf::reals(file_, plane::moment_rate_spectrum, {dimensions_.frequency}, metadata_);
    state_id_ = opaque(file_, "checkpoint", "state of the run, to resume it", state_.size());
    scenario_id_ = opaque(file_, "scenario_text", "the scenario, byte by byte", metadata_.scenario_text.size());
  }

  void write() {
    if (run_.schedule().lines) write_lines();
    std::vector<double> times;
    for (const plane::Field& field : run_.snapshots()) times.push_back(field.time);
    file_.write(time_, times);
    file_.write(y_, grid_.y());
    file_.write(x_, grid_.x());
    for (std::size_t i = 0; i < fields_.size(); ++i)
      for (std::size_t row = 0; row < times.size(); ++row)
        file_.write_row(fields_[i], row, run_.snapshots()[row].*plane::field_arrays()[i].values);
    const plane::Maps maps = run_.maps();
    for (std::size_t i = 0; i < maps_.size(); ++i) file_.write_all(maps_[i], maps.*plane::map_arrays()[i].values);
    for (std::size_t i = 0; i < series_.size(); ++i) {
      std::vector<double> values;
      for (const plane::SeriesRow& row : run_.series()) values.push_back(plane::series_numbers()[i].get(row));
      file_.write(series_[i], values);
    }
    file_.write(frequency_, frequencies_);
    file_.write(spectrum_, plane::spectrum(run_.series(), frequencies_));
    file_.write(state_id_, state_);
    file_.write(scenario_id_, metadata_.scenario_text);
  }

 private:
  void define_lines() {
    lines_ = plane::line_points(run_.snapshots());
    const int points = file_.dimension("line_point", lines_.x.size());
    for (const plane::LineArray& line : plane::line_arrays())
      line_ids_.push_back(cf::reals(file_, line.about, {points}, metadata_));
  }
  void write_lines() {
    for (std::size_t i = 0; i < line_ids_.size(); ++i)
      file_.write(line_ids_[i], lines_.*plane::line_arrays()[i].values);
  }

  Writer& file_;
  const PulseMetadata& metadata_;
  const PlaneGrid& grid_;
  const plane::Run& run_;
  const std::string& state_;
  Dimensions dimensions_{};
  std::vector<double> frequencies_;
  int time_ = 0, y_ = 0, x_ = 0, frequency_ = 0, spectrum_ = 0, state_id_ = 0, scenario_id_ = 0;
  std::vector<int> fields_, maps_, series_, line_ids_;
  plane::LinePoints lines_;
};

}  // namespace

std::vector<double> PlaneGrid::x() const { return centres(left, right, nx); }
std::vector<double> PlaneGrid::y() const { return centres(bottom, top, ny); }

void write_plane(const std::string& path, const PulseMetadata& metadata, const PlaneGrid& grid, const plane::Run& run,
                 const std::string& state) {
  const std::size_t cells = static_cast<std::size_t>(grid.nx) * static_cast<std::size_t>(grid.ny);
  std::size_t values = cells * (plane::field_arrays().size() * run.snapshots().size() + 2 * plane::map_arrays().size());
  for (const plane::Field& snapshot : run.snapshots())
    for (const plane::Line& line : snapshot.lines) values += 4 * (line.points.size() + 1);
  write_netcdf(path, values * sizeof(double) + (1 << 16), [&](Writer& file) {
    cf::describe_file(file, metadata, plane_format, run.finished());
    PlaneWriter writer(file, metadata, grid, run, state);
    writer.define();
    file.end_definitions();
    writer.write();
  });
}

}  // namespace slipfront::record
