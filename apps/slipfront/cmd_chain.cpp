#include <memory>
#include <optional>
#include <utility>

#include "batch.hpp"
#include "foundation/ranks.hpp"
#include "long_run.hpp"
#include "record/files/unfinished.hpp"
#include "run/run.hpp"
#include "terminal_table.hpp"

namespace {

using namespace slipfront;
using namespace slipfront::scenario;

void describe(const scenario::Scenario& s, const run::ChainPlan& plan, const chain::Problem& p) {
  if (p.implicit) {
    put(fitted(
        fmt::format("{}: OK. This scenario would run {} sites, {:.6g} apart, at scale {:.6g} by implicit steps of "
                    "tolerance {:.6g}, {}.",
                    s.title.empty() ? s.file : s.title, p.grid.sites, p.grid.spacing, plan.chain.scale, p.tolerance,
                    in_words(plan.need))));
    return;
  }
  put(fitted(
      fmt::format("{}: OK. This scenario would run {} sites, {:.6g} apart, at scale {:.6g} for {:.0f} steps, {}.",
                  s.title.empty() ? s.file : s.title, p.grid.sites, p.grid.spacing, plan.chain.scale,
                  s.end * plan.chain.scale / chain::chosen_step(p), in_words(plan.need))));
}

int run_chain(const ScenarioArguments& a) {
  const auto begun = Clock::now();
  scenario::Scenario s;
  run::ChainPlan plan;
  std::optional<record::Checkpoint> saved;
  the_ranks->together([&] {  // so that an error is reported only once
    s = read_scenario_of(a);
    plan = run::plan_chain(s, the_ranks->share_of_machine());
    if (!a.resume.empty()) saved = run::checkpoint_of(a.resume, s, plan, the_ranks->share_of_machine());
  });
  the_ranks->require_same("SCENARIO", s.text);
  the_ranks->require_same("--resume", saved ? saved->solver_state : "");
  const Ranks* ranks = the_ranks->size() > 1 ? the_ranks : nullptr;
  if (a.check) {
    the_ranks->together([&] { require_output(a, saved && saved->finished, plan.need.disk); });
    const auto run = run::begin(plan, {.checkpoint = std::move(saved), .threads = a.common.threads, .ranks = ranks});
    if (the_ranks->rank() == 0) describe(s, plan, run->chain().problem());
    return exit_done;
  }
  LongRun long_run(a, s, saved && saved->finished, ranks);
  const auto result = run::chain(s, plan, long_run.options(std::move(saved), begun));
  if (const int code = long_run.end(result.finished()); code != exit_done) return code;
  if (the_ranks->rank() == 0)
    print_summary(s, result.summary, result.metadata.warnings, a, s.loading.acts() ? &result.metadata.events : nullptr);
  return exit_done;
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
