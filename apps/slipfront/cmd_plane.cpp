#include <memory>
#include <optional>

#include "long_run.hpp"
#include "runs/fault.hpp"
#include "runs/tables.hpp"
#include "slipfront/lattice/plane/solvers.hpp"
#include "system/files/whole_file.hpp"
#include "system/ranks.hpp"

namespace {

using namespace slipfront;

/// The lines that a run follows, in words.
std::string lines_in_words(const scenario::Scenario& s, scenario::SolverKind solver) {
  if (solver == scenario::SolverKind::plane_direct) {
    const double scale = scenario::scale_of_lines(s);
    return fmt::format("every dislocation line at scale {}, which needs about {:.2g} GB of memory,", scale,
                       plane::memory_of_direct(s.plane->problem, {.scale = scale}) / 1e9);
  }
  if (s.plane->on_grid) return fmt::format("the mean slip in {} cells along x", s.plane->cells);
  return fmt::format("{} x {} cells of dislocation lines", s.plane->loops, s.plane->angles);
}

std::string plane_in_words(const run::Plan& plan, const output::Run&) {
  const scenario::Scenario& s = plan.scenario;
  const plane::Problem& p = s.plane->problem;
  const double ratio = s.plane->wave_speed_ratio;
  return fmt::format(
      "follow {} over x = {} ... {}, y = {} ... {} to t = {}, with results in {} x {} cells at {} times: {:.1g} GB on "
      "the disk with -o",
      lines_in_words(s, plan.solver), s.in_results(p.left, "b / A"), s.in_results(p.right, "b / A"),
      s.in_results(ratio * p.bottom, "b / A"), s.in_results(ratio * p.top, "b / A"), s.in_results(s.end, "b / (c A)"),
      plan.on_plane.nx, plan.on_plane.ny, plan.times().size(), plan.need.disk / 1e9);
}

/// The plan of a run that follows a finite-fault model.
run::Plan plan_of_model(const ScenarioArguments& a) {
  require_one_scenario(a);
  const auto model =
      std::make_shared<const run::FaultOnPlane>(run::fault_on_plane(record::read_text(a.scenario), a.scenario));
  const scenario::Scenario s = prepared(run::scenario_of_fault(*model, a.scenario, settings_of(a)), a);
  if (!model->fault.note.empty() && !a.common.quiet) complain("warning: " + model->fault.note);
  run::Plan plan = run::plan_of(scenario::SolverKind::plane_direct, s);
  plan.model = model;
  return plan;
}

int run_plane(const ScenarioArguments& a, bool direct) {
  const auto make_plan = [&] {
    if (run::is_fault_model(a.scenario)) return plan_of_model(a);
    return run::plan_of(direct ? scenario::SolverKind::plane_direct : scenario::SolverKind::plane, read_scenario_of(a));
  };
  return plan_and_run(a, Clock::now(), make_plan, plane_in_words);
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
  return [a, direct] { return run_plane(*a, *direct); };
}
