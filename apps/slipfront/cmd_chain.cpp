#include <CLI/CLI.hpp>
#include <memory>

#include "batch.hpp"
#include "chain_setup.hpp"
#include "long_run.hpp"
#include "pulse_setup.hpp"
#include "slipfront/chain/ranks.hpp"

namespace {

using namespace slipfront;

void print(const chain::Run& run, const scenario::Scenario& scenario, double stepping, double wall, long steps,
           const ScenarioArguments& arguments) {
  const pulse::Snapshot& s = run.snapshots().back();
  const chain::Problem& problem = run.chain().problem();
  const auto sites = static_cast<double>(problem.grid.sites);
  const chain::Run::Balance balance = run.balance();  // asks all ranks
  if (the_ranks->rank() > 0) return;
  print_rows(
      scenario.title,
      {
          {"time", json_number(s.time), "in b / (c A)"},
          {"scale", json_number(run.scale()), "x and t are stretched by it, friction divided"},
          {"slip_at_origin", json_number(s.slip_at_origin), "u at x = 0 since t = 0 over the scale, in b / (2 pi)"},
          {"slip_velocity_at_origin", json_number(s.slip_velocity_at_origin), "weighted mean of u_t, in c A / pi"},
          {"stress_at_origin", json_number(s.stress_at_origin), "weighted mean of -u_x, in mu A / pi"},
          {"window", json_number(run.window()), "of the slip at x = 0, in b / A"},
          {"smooth_window", json_number(run.smooth_window()), "of velocities and stresses, in b / A"},
          {"peak_slip_velocity", json_number(s.peak_slip_velocity), "largest of the profile, in c A / pi"},
          {"peak_position", json_number(s.peak_position), "its x, in b / A"},
          {"leading_front", json_number(s.fronts.leading), "x of the last dislocation, in b / A"},
          {"trailing_front_observed", json_number(s.fronts.trailing_observed),
           "as an observer with a threshold sees it"},
          {"leading_front_observed", json_number(s.fronts.leading_observed), "as an observer with a threshold sees it"},
          {"dislocations", fmt::format("{}", balance.dislocations), "at the end"},
          {"energy_phonons", json_number(s.energy.phonons), "energy that uniform trains of the same averages lack"},
          {"energy_drift", json_number(balance.energy_drift), "energy and work since t = 0, relative"},
          {"charge_error", json_number(balance.charge_error), "change of the charge"},
          {"sites", fmt::format("{}", problem.grid.sites), ""},
          {"spacing", json_number(problem.grid.spacing), "of the sites, on the chain"},
          {"steps", fmt::format("{}", run.chain().level()), ""},
          {"ranks", fmt::format("{}", the_ranks->size()), ""},
          {"threads", fmt::format("{}", arguments.common.threads), "of each rank"},
          {"site_updates_per_second", json_number(stepping > 0 ? sites * static_cast<double>(steps) / stepping : 0),
           "output included"},
          {"wall_seconds", json_number(wall), "of the whole command"},
      },
      arguments);
}

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
    if (!a.resume.empty()) saved = checkpoint_of(a, s);
  });
  if (a.check) {
    if (the_ranks->rank() > 0) return exit_done;
    const chain::Problem p = chain::problem_of(stretched);
    put(fmt::format("{}: fine. Would run {} sites, {:.6g} apart, at scale {:.6g} for {:.0f} steps: {:.3g} GB.\n",
                    s.title.empty() ? s.file : s.title, p.grid.sites, p.grid.spacing, stretched.scale,
                    s.end * stretched.scale / chain::chosen_step(p), chain::memory_needed(p) / 1e9));
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
      *run, a, s, "chain", [&] { return run->time(); }, [&] { return run->chain().level(); });
  if (code == exit_done) print(*run, s, seconds_since(begun), seconds_since(start), run->chain().level() - first, a);
  return code;
}

}  // namespace

Runner add_chain(CLI::App& app) {
  auto a = std::make_shared<ScenarioArguments>();
  CLI::App* command = app.add_subcommand("chain", "Every dislocation, directly: Eqs. (1) and (3), on a scenario");
  add_scenario_options(*command, *a);
  return [a] { return run_chain(*a); };
}
