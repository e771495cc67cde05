#include <pybind11/stl.h>

#include <optional>
#include <string>
#include <vector>

#include "results.hpp"
#include "run/errors.hpp"
#include "run/run.hpp"
#include "slipfront/scenario/problem.hpp"
#include "watch.hpp"

namespace {

using namespace slipfront;

py::dict run_pulse(const py::dict& arguments, std::optional<double> tolerance, bool with_errors) {
  const auto begun = Clock::now();
  RunRequest a = request_of(arguments);
  scenario::Scenario s = scenario_of(a);
  Watch watch(a.progress, s.end);
  run::Result<pulse::Run> result;
  std::vector<std::string> unresolved;
  {
    const py::gil_scoped_release others_may_run;
    const auto interrupted = [&] { return watch.interrupted(); };
    if (tolerance) {
      const int cells = run::cells_for(*tolerance, !a.resume.empty(), s, interrupted);
      a.set.push_back("pulse.cells=" + std::to_string(cells));
      s = scenario_of(a);
    }
    const run::PulsePlan plan = run::plan_pulse(s);
    run::Options options{.begun = begun};
    if (!a.resume.empty()) options.checkpoint = run::checkpoint_of(a.resume, s, plan);
    options.output = run::output_of(a.output, a.resume, options.checkpoint && options.checkpoint->finished);
    options.after_step = [&](double time, long steps) { return watch(time, steps); };
    result = run::pulse(s, plan, options);
    if (result.finished() && with_errors) unresolved = run::add_errors(result, s, interrupted);
  }
  watch.finish();
  result.metadata.warnings.insert(result.metadata.warnings.end(), unresolved.begin(), unresolved.end());
  return dataset_of(result);
}

py::dict check_pulse(const py::dict& arguments) {
  using namespace pybind11::literals;
  const scenario::Scenario s = scenario_of(request_of(arguments));
  const run::PulsePlan plan = run::plan_pulse(s);
  const pulse::Problem& problem = plan.problem;
  run::begin(plan, {});
  py::dict friction;
  for (const friction::Parameter& p : s.friction.definition().parameters)
    friction[py::str(std::string(p.name))] = s.friction.parameter(p.name);
  return py::dict("title"_a = s.title, "cells"_a = problem.cells, "left"_a = problem.left, "right"_a = problem.right,
                  "end"_a = s.end, "time_unit"_a = time_unit_of(s),
                  "friction_law"_a = std::string(s.friction.definition().adjective),
                  "friction_coefficient"_a = s.friction.linear_coefficient(), "friction_parameters"_a = friction,
                  "closure"_a = name_of(s.friction.closure()), "times"_a = plan.schedule.times.size(),
                  "memory_bytes"_a = plan.need.memory_with_file(), "disk_bytes"_a = plan.need.disk);
}

}  // namespace

void bind_pulse(py::module_& m) {
  m.def("pulse", run_pulse);
  m.def("check_pulse", check_pulse);
}
