#include "slipfront/setup/chain.hpp"

#include <chrono>
#include <memory>
#include <optional>

#include "results.hpp"
#include "slipfront/record/carry_out.hpp"
#include "slipfront/setup/estimate.hpp"
#include "slipfront/setup/pulse.hpp"
#include "watch.hpp"

namespace {

using namespace slipfront;
using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

py::dict run_chain(const py::dict& arguments, int threads) {
  const auto start = Clock::now();
  const Asked a = asked(arguments);
  const scenario::Scenario s = scenario_of(a);
  Watch watch(a.progress, s.end);
  std::unique_ptr<chain::Run> run;
  std::optional<record::Keeping> keeping;
  double stepping = 0;
  long steps = 0;
  chain::Run::Balance balance{};
  {
    const py::gil_scoped_release others_may_run;
    const chain::Stretched stretched = setup::chain_problem(s);
    const pulse::Schedule schedule = setup::pulse_schedule(s, setup::pulse_problem(s));
    setup::require_memory(s, stretched);
    const chain::Execution execution{.threads = threads};
    if (a.resume.empty()) {
      run = std::make_unique<chain::Run>(stretched, schedule, execution);
    } else {
      const record::Checkpoint saved = record::read_checkpoint_of(a.resume, s.text, SLIPFRONT_VERSION);
      run = std::make_unique<chain::Run>(stretched, schedule, execution, saved.solver_state, saved.snapshots);
    }
    keeping = record::Keeping{.output = {a.output.empty() ? a.resume : a.output, a.resume},
                              .metadata = metadata_of(s, "chain", schedule.x_edges),
                              .disk = setup::estimate_of(s, stretched).disk,
                              .resumed = !a.resume.empty()};
    const long first = run->chain().level();
    const auto begun = Clock::now();
    if (record::carry_out(*run, *keeping, [&] { return watch(run->time(), run->chain().level()); }))
      balance = run->balance();
    if (run->finished()) keeping->metadata.warnings = run->warnings();
    stepping = seconds_since(begun);
    steps = run->chain().level() - first;
  }
  watch.finish();
  const setup::ChainEnd end{.run = *run,
                            .balance = balance,
                            .stepping = stepping,
                            .wall = seconds_since(start),
                            .steps = steps,
                            .ranks = 1,
                            .threads = threads};
  py::dict result = dataset_of(keeping->metadata, record::pulse_format, run->finished(), run->schedule().times,
                               {&run->snapshots()}, false, s);
  result["summary"] = summary_of(setup::summary(setup::chain_summary(), end));
  return result;
}

py::dict check_chain(const py::dict& arguments) {
  using namespace pybind11::literals;
  const scenario::Scenario s = scenario_of(asked(arguments));
  const chain::Stretched stretched = setup::chain_problem(s);
  setup::require_memory(s, stretched);
  const chain::Problem p = chain::problem_of(stretched);
  const setup::Estimate need = setup::estimate_of(s, stretched);
  return py::dict("title"_a = s.title, "sites"_a = p.grid.sites, "spacing"_a = p.grid.spacing,
                  "scale"_a = stretched.scale, "left"_a = stretched.left, "right"_a = stretched.right, "end"_a = s.end,
                  "steps"_a = static_cast<long>(s.end * stretched.scale / chain::chosen_step(p)),
                  "memory_bytes"_a = need.memory_with_file(), "disk_bytes"_a = need.disk);
}

}  // namespace

void bind_chain(py::module_& m) {
  m.def("chain", run_chain);
  m.def("check_chain", check_chain);
}
