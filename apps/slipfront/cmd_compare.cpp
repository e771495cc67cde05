#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <memory>

#include "batch.hpp"
#include "chain_setup.hpp"
#include "compare.hpp"
#include "long_run.hpp"
#include "pulse_setup.hpp"
#include "slipfront/record/comparison_file.hpp"

namespace {

using namespace slipfront;

struct Arguments : ScenarioArguments {
  std::vector<double> scales;
};

std::vector<double> scales_of(const Arguments& a, const scenario::Scenario& s) {
  const auto refuse = [](double scale, const char* problem, const char* allowed) {
    throw InputError({.file = "command line",
                      .key = "--scale",
                      .value = fmt::format("{}", scale),
                      .problem = problem,
                      .allowed = allowed});
  };
  std::vector<double> scales = a.scales;
  for (const double scale : scales)
    if (!(scale > 0) || !std::isfinite(scale)) refuse(scale, "out of range", "> 0");
  if (scales.empty()) scales = s.chain.scale ? std::vector{*s.chain.scale} : std::vector{100.0, 300.0, 1000.0};
  std::sort(scales.begin(), scales.end());
  if (const auto twice = std::adjacent_find(scales.begin(), scales.end()); twice != scales.end())
    refuse(*twice, "given twice", "each scale once");
  return scales;
}

/// Runs one level to its end; false if the user interrupted.
template <class Run, class Time, class Steps>
bool carry(Run& run, Level& level, double end, const Arguments& a, Time&& time, Steps&& steps) {
  const auto begun = Clock::now();
  bool reached = false;
  try {
    Progress progress(end, !a.common.quiet, level.name);
    reached = run.go([&] {
      progress.at(time(), steps());
      return interrupted_by_user();
    });
  } catch (const NumericsError& error) {
    throw NumericsError(level.name + ": " + error.what());
  }
  level.wall_seconds = seconds_since(begun);
  level.snapshots = run.snapshots();
  return reached;
}

bool run_pulse_level(Level& level, pulse::Problem problem, modulation::Closure closure, const pulse::Schedule& schedule,
                     const Arguments& a) {
  problem.friction.closure = closure;
  pulse::Run run(std::move(problem), schedule);
  const auto& cells = [&]() -> const pulse::Cells& { return run.solver().cells(); };
  return carry(
      run, level, schedule.times.back(), a, [&] { return cells().time; }, [&] { return cells().steps; });
}

bool run_chain_level(Level& level, const chain::Stretched& stretched, const pulse::Schedule& schedule,
                     const Arguments& a) {
  chain::Run run(stretched, schedule, {.threads = a.common.threads});
  level.window = run.window();
  level.smooth_window = run.smooth_window();
  return carry(
      run, level, schedule.times.back(), a, [&] { return run.time(); }, [&] { return run.chain().level(); });
}

void write(const Arguments& a, const scenario::Scenario& s, const pulse::Schedule& schedule,
           const std::vector<Level>& levels, bool finished) {
  if (a.output.empty()) return;
  std::vector<record::ComparedLevel> compared;
  compared.reserve(levels.size());
  for (const Level& level : levels) compared.push_back({level.name, level.scale, level.snapshots});
  record::write_comparison(
      a.output,
      {s.title, s.text, SLIPFRONT_VERSION, "slipfront compare " + a.scenario, schedule.x_edges, s.output.variables},
      schedule.times, compared, finished);
}

int run_compare(const Arguments& a) {
  scenario::Scenario s = read_scenario_of(a);
  const pulse::Problem problem = pulse_problem(s);
  const pulse::Schedule schedule = pulse_schedule(s, problem);
  std::vector<chain::Stretched> chains;
  for (const double scale : scales_of(a, s)) {
    s.chain.scale = scale;
    chains.push_back(chain_problem(s));
    chain::problem_of(chains.back());  // what is wrong with any of them is known before the work, not after
  }
  std::vector<Level> levels;
  if (auto exact = closed_form(s, schedule)) levels.push_back(std::move(*exact));
  if (a.check) {
    const pulse::Run laid(problem, schedule);
    std::string text = fmt::format("{}: fine. Would compare {}pulse (consistent, paper)",
                                   s.title.empty() ? s.file : s.title, levels.empty() ? "" : "the closed form, ");
    for (const auto& c : chains)
      text += fmt::format(", chain at scale {:.6g} ({} sites)", c.scale, chain::problem_of(c).grid.sites);
    put(text + fmt::format(" over x = {:.6g} ... {:.6g} to t = {:.6g}.\n", problem.left, problem.right, s.end));
    return exit_done;
  }

  watch_interrupts();
  bool reached = true;
  const auto go = [&](Level level, auto&& run) {
    if (!reached) return;
    write(a, s, schedule, levels, false);
    reached = run(level);
    if (reached) levels.push_back(std::move(level));
  };
  using modulation::Closure;
  go({.name = "pulse-consistent", .closure = "consistent"},
     [&](Level& l) { return run_pulse_level(l, problem, Closure::consistent, schedule, a); });
  go({.name = "pulse-paper", .closure = "paper"},
     [&](Level& l) { return run_pulse_level(l, problem, Closure::paper, schedule, a); });
  for (const auto& c : chains)
    go({.name = fmt::format("chain-{:.6g}", c.scale), .scale = c.scale},
       [&](Level& l) { return run_chain_level(l, c, schedule, a); });
  write(a, s, schedule, levels, reached);
  if (!reached) {
    complain(fmt::format("interrupted; {} of {} levels were done{}", levels.size(),
                         chains.size() + 2 + (levels.empty() || levels.front().name != "closed-form" ? 0U : 1U),
                         a.output.empty() ? "" : " and are in " + a.output));
    return exit_interrupted;
  }
  print_comparison(s, levels, a.common.json);
  if (!a.output.empty() && !a.common.json && !a.common.quiet) put("written to " + a.output + "\n");
  return exit_done;
}

}  // namespace

Runner add_compare(CLI::App& app) {
  auto a = std::make_shared<Arguments>();
  CLI::App* command =
      app.add_subcommand("compare", "Closed form, pulse with both closures and chain, side by side on a scenario");
  add_scenario_options(*command, *a, false);
  command->add_option("--scale", a->scales, "Scale of a chain; repeatable (default: the scenario's, or 100, 300, 1000)")
      ->allow_extra_args(false)
      ->type_name("S");
  return [a] { return run_compare(*a); };
}
