#include <CLI/CLI.hpp>
#include <memory>

#include "batch.hpp"
#include "long_run.hpp"
#include "slipfront/record/unfinished.hpp"
#include "slipfront/setup/estimate.hpp"
#include "slipfront/setup/pulse.hpp"
#include "slipfront/setup/summary.hpp"

namespace {

using namespace slipfront;
using namespace slipfront::setup;

void describe(const scenario::Scenario& s, const pulse::Problem& problem, const std::string& output) {
  const Estimate need = estimate_of(s, problem);
  record::require_disk_space(output, need.disk);
  put(fmt::format(
      "{}: fine. Would run {} cells over x = {:.6g} ... {:.6g} to t = {:.6g}, {} friction {} (closure {}), {}.\n",
      s.title.empty() ? s.file : s.title, problem.cells, problem.left, problem.right, s.end, law_name(s.friction.law),
      s.friction.coefficient, name_of(s.friction.closure), in_words(need)));
}

int run_pulse(const ScenarioArguments& a) {
  const auto start = Clock::now();
  const scenario::Scenario s = read_scenario_of(a);
  const pulse::Problem problem = pulse_problem(s);
  const pulse::Schedule schedule = pulse_schedule(s, problem);
  if (a.check) {
    check_cells(s, problem);
    describe(s, problem, a.output);
    return exit_done;
  }
  std::unique_ptr<pulse::Run> run;
  if (a.resume.empty()) {
    run = std::make_unique<pulse::Run>(problem, schedule);
  } else {
    const record::Checkpoint saved = checkpoint_of(a, s);
    run = std::make_unique<pulse::Run>(problem, schedule, saved.solver_state, saved.snapshots);
  }
  const int code = carry_out(
      *run, a, s, "pulse", estimate_of(s, problem).disk, [&] { return run->solver().cells().time; },
      [&] { return run->solver().cells().steps; });
  if (code == exit_done)
    print_summary(s.title, summary(pulse_summary(), {s, *run, seconds_since(start)}), run->warnings(), a);
  return code;
}

}  // namespace

Runner add_pulse(CLI::App& app) {
  auto a = std::make_shared<ScenarioArguments>();
  CLI::App* command = app.add_subcommand("pulse", "The modulation equations with friction, Eqs. (7), on a scenario");
  add_scenario_options(*command, *a);
  return [a] { return run_pulse(*a); };
}
