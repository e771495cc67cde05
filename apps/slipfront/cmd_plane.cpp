#include <CLI/CLI.hpp>
#include <memory>
#include <optional>
#include <utility>

#include "batch.hpp"
#include "long_run.hpp"
#include "plane_output.hpp"
#include "run/plane.hpp"
#include "slipfront/setup/plane.hpp"

namespace {

using namespace slipfront;

void describe(const scenario::Scenario& s, const run::PlanePlan& plan) {
  setup::plane_solver(s);  // refuses what a run refuses at its start
  const record::PlaneGrid& grid = plan.grid;
  put(fmt::format(
      "{}: OK. This scenario would follow {} x {} cells of dislocation lines over x = {} ... {}, y = {} ... "
      "{} to t = {}, with results in {} x {} cells at {} times: {:.1g} GB on the disk with -o.\n",
      s.title.empty() ? s.file : s.title, s.plane->loops, s.plane->angles, in_results(s, grid.left, "b / A"),
      in_results(s, grid.right, "b / A"), in_results(s, grid.bottom, "b / A"), in_results(s, grid.top, "b / A"),
      in_results(s, s.end, "b / (c A)"), grid.nx, grid.ny, plan.schedule.times.size(), plan.disk / 1e9));
}

int run_plane(const ScenarioArguments& a) {
  const auto begun = Clock::now();
  const scenario::Scenario s = read_scenario_of(a);
  const run::PlanePlan plan = run::plan_plane(s);
  std::optional<record::PlaneCheckpoint> saved;
  if (!a.resume.empty()) saved = run::plane_checkpoint_of(a.resume, s);
  const bool of_finished = saved && saved->finished;
  if (a.check) {
    require_output(a, of_finished, plan.disk);
    describe(s, plan);
    return exit_done;
  }
  LongRun long_run(a, s, of_finished, nullptr);
  const auto result = run::plane(s, plan, {.common = long_run.options({}, begun), .checkpoint = std::move(saved)});
  if (const int code = long_run.end(result.finished()); code != exit_done) return code;
  print_plane(s, result, run::plane_errors(s, result.numbers, {}), a);
  return exit_done;
}

}  // namespace

Runner add_plane(CLI::App& app) {
  auto a = std::make_shared<ScenarioArguments>();
  CLI::App* command = app.add_subcommand("plane", "A rupture on a fault plane, on a scenario with the table [plane]");
  command->footer(
      "Examples:"
      "\n  slipfront plane cases/plane-friction.toml -o plane.nc"
      "\n  slipfront plane cases/plane-friction.toml --set plane.loops=240 --json"
      "\n  slipfront plane cases/plane-friction.toml --check");
  add_scenario_options(*command, *a);
  return [a] { return run_plane(*a); };
}
