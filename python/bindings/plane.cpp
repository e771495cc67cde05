#include "run/plane.hpp"

#include <pybind11/stl.h>

#include <optional>

#include "record/files/text_file.hpp"
#include "results.hpp"
#include "run/fault_plane.hpp"
#include "watch.hpp"

namespace {

using namespace slipfront;

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
  const scenario::Lines lines = direct || is_model(a) ? scenario::Lines::direct : scenario::Lines::averaged;
  Watch watch(a.progress, s.end);
  run::PlanePlan plan;
  run::PlaneResult result;
  {
    const py::gil_scoped_release others_may_run;
    plan = run::plan_plane(s, lines);
    run::Options options{.threads = threads, .begun = begun};
    if (!a.resume.empty()) options.checkpoint = run::checkpoint_of(a.resume, s, plan);
    options.output = run::output_of(a.output, a.resume, options.checkpoint && options.checkpoint->finished);
    options.after_step = [&](double time, long steps) { return watch(time, steps); };
    result = run::plane(s, plan, options);
    if (with_errors && !all.model && result.finished())
      run::add_errors(
          result, s, [&] { return watch.interrupted(); }, lines, threads);
  }
  watch.finish();
  py::dict data =
      dataset_of(result.metadata, record::plane_format, result.finished(), record::arrays_of(*result.run, plan.grid));
  if (all.model && result.finished()) {
    for (run::Row& row : run::compare_with_model(*all.model, s, result)) result.summary.push_back(std::move(row));
    if (!all.model->fault.note.empty()) data["warnings"].cast<py::list>().append(all.model->fault.note);
  }
  add_rows(data, result.summary, s.results_in);
  return data;
}

py::dict check_plane(const py::dict& arguments, bool direct) {
  using namespace pybind11::literals;
  const RunRequest a = request_of(arguments);
  const scenario::Scenario s = requested(a).scenario;
  const scenario::Lines lines = direct || is_model(a) ? scenario::Lines::direct : scenario::Lines::averaged;
  const run::PlanePlan plan = run::plan_plane(s, lines);
  scenario::plane_solver(s, lines, 1);
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
