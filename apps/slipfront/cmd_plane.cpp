#include <memory>
#include <optional>
#include <utility>

#include "batch.hpp"
#include "foundation/ranks.hpp"
#include "long_run.hpp"
#include "run/fault_plane.hpp"
#include "run/plane.hpp"
#include "slipfront/plane/solvers.hpp"
#include "slipfront/scenario/problem.hpp"
#include "terminal_table.hpp"

namespace {

using namespace slipfront;

/// The lines that a run would follow, in words. Refuses what a run refuses at its start.
std::string solver_in_words(const scenario::Scenario& s, scenario::Lines lines, int threads, const Ranks* ranks) {
  if (lines == scenario::Lines::direct) {
    const plane::DirectOptions options{.scale = scenario::scale_of_lines(s), .threads = threads};
    scenario::plane_solver(s, lines, threads, ranks);
    return fmt::format("every dislocation line at scale {}, which needs about {:.2g} GB of memory,", options.scale,
                       plane::memory_of_direct(s.plane->problem, options) / 1e9);
  }
  scenario::plane_solver(s, lines, threads);
  if (s.plane->on_grid) return fmt::format("the mean slip in {} cells along x", s.plane->cells);
  return fmt::format("{} x {} cells of dislocation lines", s.plane->loops, s.plane->angles);
}

void describe(const scenario::Scenario& s, const run::PlanePlan& plan, const std::string& solver) {
  const record::PlaneGrid& grid = plan.grid;
  put(fitted(fmt::format(
      "{}: OK. This scenario would follow {} over x = {} ... {}, y = {} ... {} to t = {}, with results in "
      "{} x {} cells at {} times: {:.1g} GB on the disk with -o.",
      s.title.empty() ? s.file : s.title, solver, s.in_results(grid.left, "b / A"), s.in_results(grid.right, "b / A"),
      s.in_results(grid.bottom, "b / A"), s.in_results(grid.top, "b / A"), s.in_results(s.end, "b / (c A)"), grid.nx,
      grid.ny, plan.schedule.times.size(), plan.disk / 1e9)));
}

bool is_model(const ScenarioArguments& a) { return a.scenario.ends_with(".fsp"); }

/// Runs a scenario. If it was made from a finite-fault model, it compares the results with the model.
int run_scenario(const ScenarioArguments& a, const scenario::Scenario& s, scenario::Lines lines,
                 const run::FaultOnPlane* model, Clock::time_point begun) {
  const Ranks* const ranks = lines == scenario::Lines::direct && the_ranks->size() > 1 ? the_ranks : nullptr;
  if (!ranks && the_ranks->rank() > 0) return exit_done;  // the averages are those of one process
  run::PlanePlan plan;
  std::optional<record::Checkpoint> saved;
  const auto prepare = [&] {
    plan = run::plan_plane(s, lines);
    if (!a.resume.empty()) saved = run::checkpoint_of(a.resume, s, plan);
    if (a.check) require_output(a, saved && saved->finished, plan.disk);
  };
  ranks ? ranks->together(prepare) : prepare();
  if (a.check) {
    const std::string solver = solver_in_words(s, lines, a.common.threads, ranks);
    if (the_ranks->rank() == 0) describe(s, plan, solver);
    return exit_done;
  }
  LongRun long_run(a, s, saved && saved->finished, ranks);
  auto result = run::plane(s, plan, long_run.options(std::move(saved), begun));
  if (const int code = long_run.end(result.finished()); code != exit_done) return code;
  if (!ranks && !model) run::add_errors(result, s, {}, lines, a.common.threads);
  if (the_ranks->rank() > 0) return exit_done;
  if (model)
    for (run::Row& row : run::compare_with_model(*model, s, result)) result.summary.push_back(std::move(row));
  print_summary(s, result.summary, result.metadata.warnings, a);
  return exit_done;
}

int run_plane(const ScenarioArguments& a, scenario::Lines lines) {
  const auto begun = Clock::now();
  scenario::Scenario s;
  std::optional<run::FaultOnPlane> model;
  the_ranks->together([&] {  // so that an error is reported only once
    if (!is_model(a)) {
      s = read_scenario_of(a);
      return;
    }
    require_one_scenario(a);
    model = run::fault_on_plane(record::read_text(a.scenario), a.scenario);
    s = prepared(run::scenario_of_fault(*model, a.scenario, settings_of(a)), a);
  });
  the_ranks->require_same("SCENARIO", s.text);
  if (!model) return run_scenario(a, s, lines, nullptr, begun);
  if (!model->fault.note.empty() && !a.common.quiet) complain("warning: " + model->fault.note);
  return run_scenario(a, s, scenario::Lines::direct, &*model, begun);
}

}  // namespace

Runner add_plane(CommandLine& program) {
  auto a = std::make_shared<ScenarioArguments>();
  CommandLine command = program.command(
      "plane", "A rupture on a fault plane, on a scenario with the table [plane]",
      {"slipfront plane cases/plane-friction.toml -o plane.nc",
       "slipfront plane cases/plane-friction.toml --set plane.loops=240 --json",
       "slipfront plane cases/plane-friction.toml --direct --set chain.scale=40",
       "slipfront plane cases/synthetic-fault.fsp -o fault.nc", "slipfront plane cases/plane-friction.toml --check"});
  add_scenario_options(command, *a);
  auto direct = std::make_shared<bool>(false);
  command.flag(
      "--direct", *direct,
      "Follow every dislocation line, as a finite-fault model always does; chain.scale sets how many there are");
  return [a, direct] { return run_plane(*a, *direct ? scenario::Lines::direct : scenario::Lines::averaged); };
}
