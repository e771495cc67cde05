#include <pybind11/stl.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "results.hpp"
#include "runs/errors.hpp"
#include "runs/fault.hpp"
#include "runs/run.hpp"
#include "runs/tables.hpp"
#include "system/files/whole_file.hpp"
#include "watch.hpp"

namespace {

using namespace slipfront;
using namespace pybind11::literals;
using scenario::SolverKind;

/// Runs a scenario with the plan that `make_plan` makes without the GIL.
py::dict run_planned(const RunRequest& a, double end, bool with_errors, int threads,
                     const std::function<run::Plan(const std::function<bool()>& interrupted)>& make_plan) {
  run::Options options{.threads = threads, .begun = a.begun};
  Watch watch(a.progress, end);
  const auto interrupted = [&] { return watch.interrupted(); };
  run::Plan plan;
  run::Result result;
  {
    const py::gil_scoped_release others_may_run;
    plan = make_plan(interrupted);
    if (!a.resume.empty()) options.checkpoint = run::checkpoint_of(a.resume, plan);
    options.output = run::output_of(a.output, a.resume, options.checkpoint && options.checkpoint->finished);
    options.after_step = [&](double time, long steps) { return watch(time, steps); };
    result = run::carry_out(plan, options);
    if (result.finished() && with_errors && result.add_errors)
      for (std::string& warning : result.add_errors(result.summary, interrupted))
        result.metadata.warnings.push_back(std::move(warning));
  }
  watch.finish();
  py::dict data = dataset_of(result.metadata, result.finished(), result.arrays());
  add_rows(data, result.summary, result.metadata.units);
  if (plan.model && result.finished() && !plan.model->fault.note.empty())
    data["warnings"].cast<py::list>().append(plan.model->fault.note);
  return data;
}

py::dict run_pulse(const py::dict& arguments, std::optional<double> tolerance, bool with_errors) {
  RunRequest a = request_of(arguments);
  scenario::Scenario s = scenario_of(a);
  return run_planned(a, s.end, with_errors, 1, [&](const auto& interrupted) {
    if (tolerance) {
      const int cells = run::cells_for(*tolerance, !a.resume.empty(), s, interrupted);
      a.set.push_back("pulse.cells=" + std::to_string(cells));
      s = scenario_of(a);
    }
    return run::plan_of(SolverKind::pulse, s);
  });
}

py::dict run_chain(const py::dict& arguments, int threads) {
  const RunRequest a = request_of(arguments);
  const scenario::Scenario s = scenario_of(a);
  return run_planned(a, s.end, true, threads, [&](const auto&) { return run::plan_of(SolverKind::chain, s); });
}

/// The plan of a run on a plane, of a scenario or of a finite-fault model.
run::Plan plan_plane(const RunRequest& a, bool direct) {
  if (!run::is_fault_model(a.path))
    return run::plan_of(direct ? SolverKind::plane_direct : SolverKind::plane, scenario_of(a));

  const py::gil_scoped_release others_may_run;
  const auto model = std::make_shared<const run::FaultOnPlane>(run::fault_on_plane(record::read_text(a.path), a.path));
  scenario::Scenario s = run::scenario_of_fault(*model, a.path, a.set);
  run::require_inputs_kept(s, a.output);
  run::choose_units(s, a.si);
  run::Plan plan = run::plan_of(SolverKind::plane_direct, std::move(s));
  plan.model = model;
  return plan;
}

py::dict run_plane(const py::dict& arguments, bool direct, bool with_errors, int threads) {
  const RunRequest a = request_of(arguments);
  const run::Plan plan = plan_plane(a, direct);
  return run_planned(a, plan.scenario.end, with_errors, threads, [&](const auto&) { return plan; });
}

py::dict check_pulse(const py::dict& arguments) {
  const run::Plan plan = run::plan_of(SolverKind::pulse, scenario_of(request_of(arguments)));
  const scenario::Scenario& s = plan.scenario;
  const pulse::Problem& problem = plan.pulse;
  run::begin(plan, {});
  py::dict friction;
  for (const friction::Parameter& p : s.friction.definition().parameters)
    friction[py::str(std::string(p.name))] = s.friction.parameter(p.name);
  return py::dict("title"_a = s.title, "cells"_a = problem.cells, "left"_a = problem.left, "right"_a = problem.right,
                  "end"_a = s.end, "time_unit"_a = time_unit_of(s),
                  "friction_law"_a = std::string(s.friction.definition().adjective),
                  "friction_coefficient"_a = s.friction.linear_coefficient(), "friction_parameters"_a = friction,
                  "closure"_a = name_of(s.friction.closure()), "times"_a = plan.times().size(),
                  "memory_bytes"_a = plan.need.memory_with_file(), "disk_bytes"_a = plan.need.disk);
}

py::dict check_chain(const py::dict& arguments) {
  const run::Plan plan = run::plan_of(SolverKind::chain, scenario_of(request_of(arguments)));
  const scenario::Scenario& s = plan.scenario;
  run::begin(plan, {});
  const chain::Problem p = chain::problem_of(plan.chain);
  return py::dict("title"_a = s.title, "sites"_a = p.grid.sites, "spacing"_a = p.grid.spacing,
                  "scale"_a = plan.chain.scale, "left"_a = plan.chain.left, "right"_a = plan.chain.right,
                  "end"_a = s.end, "steps"_a = static_cast<long>(s.end * plan.chain.scale / chain::chosen_step(p)),
                  "memory_bytes"_a = plan.need.memory_with_file(), "disk_bytes"_a = plan.need.disk);
}

py::dict check_plane(const py::dict& arguments, bool direct) {
  const run::Plan plan = plan_plane(request_of(arguments), direct);
  const scenario::Scenario& s = plan.scenario;
  const plane::Problem& p = s.plane->problem;
  const double ratio = s.plane->wave_speed_ratio;
  run::begin(plan, {});
  return py::dict("title"_a = s.title, "loops"_a = s.plane->loops, "angles"_a = s.plane->angles, "left"_a = p.left,
                  "right"_a = p.right, "bottom"_a = ratio * p.bottom, "top"_a = ratio * p.top,
                  "cells_x"_a = plan.on_plane.nx, "cells_y"_a = plan.on_plane.ny, "end"_a = s.end,
                  "time_unit"_a = time_unit_of(s), "disk_bytes"_a = plan.need.disk);
}

}  // namespace

void bind_runs(py::module_& m) {
  m.def("pulse", run_pulse);
  m.def("check_pulse", check_pulse);
  m.def("chain", run_chain);
  m.def("check_chain", check_chain);
  m.def("plane", run_plane);
  m.def("check_plane", check_plane);
  m.def("is_fault_model", run::is_fault_model);
}
