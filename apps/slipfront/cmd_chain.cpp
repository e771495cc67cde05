#include <memory>

#include "long_run.hpp"
#include "system/ranks.hpp"

namespace {

using namespace slipfront;

std::string chain_in_words(const run::Plan& plan, const output::Run&) {
  const chain::Problem p = chain::problem_of(plan.chain, plan.share_of_machine);
  const std::string how =
      p.implicit ? fmt::format("by implicit steps of tolerance {:.6g}", p.tolerance)
                 : fmt::format("for {:.0f} steps", plan.scenario.end * plan.chain.scale / chain::chosen_step(p));
  return fmt::format("run {} sites, {:.6g} apart, at scale {:.6g} {}, {}", p.grid.sites, p.grid.spacing,
                     plan.chain.scale, how, in_words(plan.need));
}

int run_chain(const ScenarioArguments& a) {
  const auto make_plan = [&] {
    return run::plan_of(scenario::SolverKind::chain, read_scenario_of(a), the_ranks->share_of_machine());
  };
  return plan_and_run(a, Clock::now(), make_plan, chain_in_words);
}

}  // namespace

Runner add_chain(CommandLine& program) {
  auto a = std::make_shared<ScenarioArguments>();
  CommandLine command =
      program.command("chain", "The chain, which follows every dislocation: Eqs. (1) and (3), on a scenario",
                      {"slipfront chain cases/step-viscous.toml --set chain.scale=100 -o chain.nc",
                       "slipfront chain cases/stick-slip.toml --check"});
  add_scenario_options(command, *a);
  return [a] { return run_chain(*a); };
}
