#include "slipfront/setup/pulse.hpp"

#include <chrono>
#include <memory>
#include <optional>

#include "results.hpp"
#include "slipfront/record/carry_out.hpp"
#include "slipfront/setup/estimate.hpp"
#include "watch.hpp"

namespace {

using namespace slipfront;

py::dict run_pulse(const py::dict& arguments) {
  const auto start = std::chrono::steady_clock::now();
  const Asked a = asked(arguments);
  const scenario::Scenario s = scenario_of(a);
  Watch watch(a.progress, s.end);
  std::unique_ptr<pulse::Run> run;
  std::optional<record::Keeping> keeping;
  {
    const py::gil_scoped_release others_may_run;
    const pulse::Problem problem = setup::pulse_problem(s);
    const pulse::Schedule schedule = setup::pulse_schedule(s, problem);
    if (a.resume.empty()) {
      run = std::make_unique<pulse::Run>(problem, schedule);
    } else {
      const record::Checkpoint saved = record::read_checkpoint_of(a.resume, s.text, SLIPFRONT_VERSION);
      run = std::make_unique<pulse::Run>(problem, schedule, saved.solver_state, saved.snapshots);
    }
    keeping = record::Keeping{.output = {a.output.empty() ? a.resume : a.output, a.resume},
                              .metadata = metadata_of(s, "pulse", schedule.x_edges),
                              .disk = setup::estimate_of(s, problem).disk,
                              .resumed = !a.resume.empty()};
    const pulse::Solver& solver = run->solver();
    record::carry_out(*run, *keeping, [&] { return watch(solver.cells().time, solver.cells().steps); });
  }
  if (run->finished()) keeping->metadata.warnings = run->warnings();
  watch.finish();
  const double wall = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  py::dict result = dataset_of(keeping->metadata, record::pulse_format, run->finished(), run->schedule().times,
                               {&run->snapshots()}, false, s);
  result["summary"] = summary_of(setup::summary(setup::pulse_summary(), {s, *run, wall}));
  return result;
}

py::dict check_pulse(const py::dict& arguments) {
  using namespace pybind11::literals;
  const scenario::Scenario s = scenario_of(asked(arguments));
  const pulse::Problem problem = setup::pulse_problem(s);
  const pulse::Schedule schedule = setup::pulse_schedule(s, problem);
  setup::check_cells(s, problem);
  const setup::Estimate need = setup::estimate_of(s, problem);
  return py::dict("title"_a = s.title, "cells"_a = problem.cells, "left"_a = problem.left, "right"_a = problem.right,
                  "end"_a = s.end, "friction_law"_a = setup::law_name(s.friction.law),
                  "friction_coefficient"_a = s.friction.coefficient, "closure"_a = name_of(s.friction.closure),
                  "times"_a = schedule.times.size(), "memory_bytes"_a = need.memory_with_file(),
                  "disk_bytes"_a = need.disk);
}

}  // namespace

void bind_pulse(py::module_& m) {
  m.def("pulse", run_pulse);
  m.def("check_pulse", check_pulse);
}
