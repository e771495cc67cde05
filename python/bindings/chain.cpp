#include "results.hpp"
#include "run/run.hpp"
#include "watch.hpp"

namespace {

using namespace slipfront;

py::dict run_chain(const py::dict& arguments, int threads) {
  const auto begun = Clock::now();
  const RunRequest a = request_of(arguments);
  const scenario::Scenario s = scenario_of(a);
  Watch watch(a.progress, s.end);
  run::Result<chain::Run> result;
  {
    const py::gil_scoped_release others_may_run;
    const run::ChainPlan plan = run::plan_chain(s);
    run::Options options{.threads = threads, .begun = begun};
    if (!a.resume.empty()) options.checkpoint = run::checkpoint_of(a.resume, s, plan);
    options.output = run::output_of(a.output, a.resume, options.checkpoint && options.checkpoint->finished);
    options.after_step = [&](double time, long steps) { return watch(time, steps); };
    result = run::chain(s, plan, options);
  }
  watch.finish();
  return dataset_of(result);
}

py::dict check_chain(const py::dict& arguments) {
  using namespace pybind11::literals;
  const scenario::Scenario s = scenario_of(request_of(arguments));
  const run::ChainPlan plan = run::plan_chain(s);
  run::begin(plan, {});
  const chain::Problem p = chain::problem_of(plan.chain);
  return py::dict("title"_a = s.title, "sites"_a = p.grid.sites, "spacing"_a = p.grid.spacing,
                  "scale"_a = plan.chain.scale, "left"_a = plan.chain.left, "right"_a = plan.chain.right,
                  "end"_a = s.end, "steps"_a = static_cast<long>(s.end * plan.chain.scale / chain::chosen_step(p)),
                  "memory_bytes"_a = plan.need.memory_with_file(), "disk_bytes"_a = plan.need.disk);
}

}  // namespace

void bind_chain(py::module_& m) {
  m.def("chain", run_chain);
  m.def("check_chain", check_chain);
}
