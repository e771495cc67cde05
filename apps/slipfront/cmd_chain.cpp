#include <CLI/CLI.hpp>
#include <memory>

#include "batch.hpp"
#include "long_run.hpp"
#include "slipfront/chain/ranks.hpp"
#include "slipfront/record/unfinished.hpp"
#include "slipfront/setup/chain.hpp"
#include "slipfront/setup/estimate.hpp"
#include "slipfront/setup/pulse.hpp"
#include "slipfront/setup/summary.hpp"

namespace {

using namespace slipfront;
using namespace slipfront::setup;

int run_chain(const ScenarioArguments& a) {
  const auto start = Clock::now();
  scenario::Scenario s;
  chain::Stretched stretched;
  pulse::Schedule schedule;
  record::Checkpoint saved;
  the_ranks->together([&] {  // so that what is wrong is said once
    s = read_scenario_of(a);
    stretched = chain_problem(s);
    schedule = pulse_schedule(s, pulse_problem(s));
    require_memory(s, stretched, the_ranks->share_of_machine());
    if (!a.resume.empty()) saved = checkpoint_of(a, s);
  });
  the_ranks->require_same("SCENARIO", s.text);
  the_ranks->require_same("--resume", saved.solver_state);
  if (a.check) {
    if (the_ranks->rank() > 0) return exit_done;
    const chain::Problem p = chain::problem_of(stretched);
    const Estimate need = estimate_of(s, stretched);
    record::require_disk_space(a.output, need.disk);
    put(fmt::format("{}: fine. Would run {} sites, {:.6g} apart, at scale {:.6g} for {:.0f} steps, {}.\n",
                    s.title.empty() ? s.file : s.title, p.grid.sites, p.grid.spacing, stretched.scale,
                    s.end * stretched.scale / chain::chosen_step(p), in_words(need)));
    return exit_done;
  }
  const chain::Execution execution{.threads = a.common.threads, .ranks = the_ranks->size() > 1 ? the_ranks : nullptr};
  std::unique_ptr<chain::Run> run;
  if (a.resume.empty()) {
    run = std::make_unique<chain::Run>(stretched, schedule, execution);
  } else {
    run = std::make_unique<chain::Run>(stretched, schedule, execution, saved.solver_state, saved.snapshots);
  }
  const long first = run->chain().level();
  const auto begun = Clock::now();
  const int code = carry_out(
      *run, a, s, "chain", estimate_of(s, stretched).disk, [&] { return run->time(); },
      [&] { return run->chain().level(); });
  if (code != exit_done) return code;
  const ChainEnd end{.run = *run,
                     .balance = run->balance(),  // asks all ranks
                     .stepping = seconds_since(begun),
                     .wall = seconds_since(start),
                     .steps = run->chain().level() - first,
                     .ranks = the_ranks->size(),
                     .threads = a.common.threads};
  const std::vector<std::string> warnings = run->warnings();  // asks all ranks
  if (the_ranks->rank() == 0) print_summary(s.title, summary(chain_summary(), end), {}, warnings, a);
  return code;
}

}  // namespace

Runner add_chain(CLI::App& app) {
  auto a = std::make_shared<ScenarioArguments>();
  CLI::App* command = app.add_subcommand("chain", "Every dislocation, directly: Eqs. (1) and (3), on a scenario");
  add_scenario_options(*command, *a);
  return [a] { return run_chain(*a); };
}
