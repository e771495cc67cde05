#include "run/plane.hpp"

#include <pybind11/stl.h>

#include <cmath>
#include <optional>

#include "record/files/text_file.hpp"
#include "results.hpp"
#include "run/fault_plane.hpp"
#include "slipfront/plane/quantities.hpp"
#include "slipfront/plane/source_parameters.hpp"
#include "watch.hpp"

namespace {

using namespace slipfront;
using Shape = std::vector<py::ssize_t>;

py::array_t<double> array(const Shape& shape, const std::vector<double>& values) {
  return py::array_t<double>(shape, values.data());
}

py::ssize_t size_of(const std::vector<double>& values) { return static_cast<py::ssize_t>(values.size()); }

py::dict axes_of(const run::PlanePlan& plan, const plane::Run& run, Describer& described_in) {
  std::vector<double> times;
  for (const plane::Field& field : run.snapshots()) times.push_back(field.time);
  py::dict axes;
  const auto add = [&](const Description& about, const std::vector<double>& values) {
    axes[py::str(std::string(about.name))] = py::make_tuple(described_in(about), array({size_of(values)}, values));
  };
  add(plane::time_axis, times);
  add(plane::y_axis, plan.grid.y());
  add(plane::x_axis, plan.grid.x());
  return axes;
}

/// Variables over time, y and x.
py::list fields_of(const Shape& cells, const plane::Run& run, Describer& described_in) {
  py::list fields;
  for (const plane::FieldArray& field : plane::field_arrays()) {
    std::vector<double> all;
    for (const plane::Field& snapshot : run.snapshots())
      all.insert(all.end(), (snapshot.*field.values).begin(), (snapshot.*field.values).end());
    const auto times = static_cast<py::ssize_t>(run.snapshots().size());
    fields.append(py::make_tuple(described_in(field.about), array({times, cells[0], cells[1]}, all)));
  }
  return fields;
}

py::list maps_of(const Shape& cells, const plane::Run& run, Describer& described_in) {
  py::list maps;
  const plane::Maps all = run.maps();
  for (const plane::MapArray& map : plane::map_arrays())
    maps.append(py::make_tuple(described_in(description_of(map, run.schedule())), array(cells, all.*map.values)));
  return maps;
}

py::list series_of(const plane::Run& run, Describer& described_in) {
  py::list series;
  for (const plane::SeriesNumber& column : plane::series_numbers()) {
    std::vector<double> values;
    values.reserve(run.series().size());
    for (const plane::SeriesRow& row : run.series()) values.push_back(column.get(row));
    series.append(py::make_tuple(described_in(column.about), array({size_of(values)}, values)));
  }
  return series;
}

/// The spectrum of the moment rate over its frequencies.
py::list spectrum_of(const plane::Run& run, Describer& described_in) {
  const std::vector<double> frequencies = plane::spectrum_frequencies(run.series()),
                            amplitudes = plane::spectrum(run.series(), frequencies);
  py::list columns;
  columns.append(py::make_tuple(described_in(plane::frequency_axis), array({size_of(frequencies)}, frequencies)));
  columns.append(py::make_tuple(described_in(plane::moment_rate_spectrum), array({size_of(amplitudes)}, amplitudes)));
  return columns;
}

/// Variables over the points of dislocation lines, if the scenario asks for them.
py::list lines_of(const plane::Run& run, Describer& described_in) {
  py::list lines;
  if (!run.schedule().lines) return lines;
  const plane::LinePoints points = plane::line_points(run.snapshots());
  for (const plane::LineArray& line : plane::line_arrays()) {
    const std::vector<double>& values = points.*line.values;
    lines.append(py::make_tuple(described_in(line.about), array({size_of(values)}, values)));
  }
  return lines;
}

/// Returns {attributes, axes, fields, maps, lines, series, spectrum, warnings, units} for the Python part.
py::dict plane_dataset(const run::PlanePlan& plan, const run::PlaneResult& result) {
  const plane::Run& run = *result.run;
  const Shape cells = {plan.grid.ny, plan.grid.nx};
  Describer described_in(result.metadata.units);
  py::dict data;
  data["attributes"] = attributes_of(result.metadata, record::plane_format, result.finished());
  data["axes"] = axes_of(plan, run, described_in);
  data["fields"] = fields_of(cells, run, described_in);
  data["maps"] = maps_of(cells, run, described_in);
  data["lines"] = lines_of(run, described_in);
  data["series"] = series_of(run, described_in);
  data["spectrum"] = spectrum_of(run, described_in);
  data["warnings"] = py::cast(result.metadata.warnings);
  data["units"] = described_in.units();
  return data;
}

bool is_model(const RunRequest& a) { return a.path.ends_with(".fsp"); }

/// The scenario of a request, and the finite-fault model that it may name.
struct Requested {
  std::optional<run::FaultOnPlane> model;
  scenario::Scenario scenario;
};
Requested requested(const RunRequest& a) {
  if (!is_model(a)) return {.model = {}, .scenario = scenario_of(a)};
  const py::gil_scoped_release others_may_run;
  Requested all;
  all.model = run::fault_on_plane(record::read_text(a.path), a.path);
  all.scenario = run::scenario_of_fault(*all.model, a.path, a.set);
  run::require_inputs_kept(all.scenario, a.output);
  run::choose_units(all.scenario, a.si);
  return all;
}

py::dict run_plane(const py::dict& arguments, bool direct, bool with_errors, int threads) {
  const auto begun = Clock::now();
  const RunRequest a = request_of(arguments);
  const Requested all = requested(a);
  const scenario::Scenario& s = all.scenario;
  const setup::Lines lines = direct || is_model(a) ? setup::Lines::direct : setup::Lines::averaged;
  Watch watch(a.progress, s.end);
  run::PlanePlan plan;
  run::PlaneResult result;
  run::PlaneNumbers errors;
  {
    const py::gil_scoped_release others_may_run;
    plan = run::plan_plane(s, lines);
    run::PlaneOptions options{.common = {.threads = threads, .begun = begun}};
    if (!a.resume.empty()) options.checkpoint = run::plane_checkpoint_of(a.resume, s, plan);
    options.common.output = run::output_of(a.output, a.resume, options.checkpoint && options.checkpoint->finished);
    options.common.after_step = [&](double time, long steps) { return watch(time, steps); };
    result = run::plane(s, plan, options);
    errors = with_errors && !all.model && result.finished()
                 ? run::plane_errors(
                       s, result.numbers, [&] { return watch.interrupted(); }, lines, threads)
                 : run::unknown_errors(result.numbers);
  }
  watch.finish();
  py::dict data = plane_dataset(plan, result);
  std::vector<run::Row> rows;
  if (result.finished()) rows = rows_of(result, errors);
  if (all.model && result.finished()) {
    for (run::Row& row : run::compare_with_model(*all.model, s, result)) rows.push_back(std::move(row));
    if (!all.model->fault.note.empty()) data["warnings"].cast<py::list>().append(all.model->fault.note);
  }
  add_rows(data, std::move(rows), s.results_in);
  return data;
}

py::dict check_plane(const py::dict& arguments, bool direct) {
  using namespace pybind11::literals;
  const RunRequest a = request_of(arguments);
  const scenario::Scenario s = requested(a).scenario;
  const setup::Lines lines = direct || is_model(a) ? setup::Lines::direct : setup::Lines::averaged;
  const run::PlanePlan plan = run::plan_plane(s, lines);
  setup::plane_solver(s, lines, 1);
  return py::dict("title"_a = s.title, "loops"_a = s.plane->loops, "angles"_a = s.plane->angles,
                  "left"_a = plan.grid.left, "right"_a = plan.grid.right, "bottom"_a = plan.grid.bottom,
                  "top"_a = plan.grid.top, "cells_x"_a = plan.grid.nx, "cells_y"_a = plan.grid.ny, "end"_a = s.end,
                  "time_unit"_a = time_unit_of(s), "disk_bytes"_a = plan.disk);
}

}  // namespace

void bind_plane(py::module_& m) {
  m.def("plane", run_plane);
  m.def("check_plane", check_plane);
}
