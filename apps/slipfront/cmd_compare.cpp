#include <fmt/format.h>

#include <memory>
#include <optional>

#include "batch.hpp"
#include "compare_print.hpp"
#include "interrupts.hpp"
#include "long_run.hpp"
#include "runs/run.hpp"
#include "scenario/estimate.hpp"
#include "slipfront/scenario/problem.hpp"
#include "system/files/whole_file.hpp"
#include "terminal_table.hpp"

namespace {

using namespace slipfront;

struct CompareArguments : ScenarioArguments {
  std::vector<double> scales;
};

void describe(const scenario::Scenario& s, const run::Comparison& c, const CompareArguments& a) {
  record::require_disk_space(record::Output(a.output, "").finished(), c.need.disk);
  const double seconds = run::expected_seconds(c, a.common.threads);
  std::string text = fmt::format("{}: OK. The comparison would run {}pulse (consistent, paper)",
                                 s.title.empty() ? s.file : s.title, c.exact ? "the closed form, " : "");
  for (const run::Plan& plan : c.plans)
    if (plan.solver == scenario::SolverKind::chain)
      text +=
          fmt::format(", chain at scale {:.6g} ({} sites)", plan.chain.scale, chain::problem_of(plan.chain).grid.sites);
  put(fitted(text + fmt::format(" over x = {} ... {} to t = {}, {}. It would take {} on this machine.",
                                s.in_results(c.schedule.x_edges.front(), "b / A"),
                                s.in_results(c.schedule.x_edges.back(), "b / A"), s.in_results(s.end, "b / (c A)"),
                                in_words(c.need), ::in_words(seconds))));
}

int run_compare(const CompareArguments& a) {
  const scenario::Scenario s = read_scenario_of(a);
  const run::Comparison comparison = run::comparison_of(s, a.scales);
  if (a.check) {
    describe(s, comparison, a);
    return exit_done;
  }
  const record::Output output(a.output, "");
  record::require_disk_space(a.output, comparison.need.disk);
  if (output.wanted()) interrupted_means("; the finished levels are in " + output.unfinished(), output.unfinished());
  const WatchInterrupts watch;
  std::vector<run::ComparedModel> levels;
  std::optional<Progress> progress;
  const bool reached = run::compare(
      comparison, run::metadata_of(s, record::comparison_format, "compare", a.scales), output, a.common.threads, levels,
      [&] { progress.reset(); },
      [&](const std::string& level, double time, long steps) {
        if (!progress) progress.emplace(s.end, !a.common.quiet, level, progress_words(s));
        progress->at(time, steps);
        return interrupted_by_user();
      });
  progress.reset();
  if (!reached) {
    complain(fmt::format("interrupted; {} of {} levels are finished{}", levels.size(), comparison.levels(),
                         a.output.empty() ? "" : " and are in " + output.unfinished()));
    return exit_interrupted;
  }
  print_comparison(s, levels, a.common.json);
  if (!a.output.empty() && !a.common.json && !a.common.quiet) put(fitted("written to " + a.output));
  return exit_done;
}

}  // namespace

Runner add_compare(CommandLine& program) {
  auto a = std::make_shared<CompareArguments>();
  CommandLine command =
      program.command("compare", "Closed form, pulse with both closures and chain, side by side on a scenario",
                      {"slipfront compare cases/step-viscous.toml"});
  add_scenario_options(command, *a, false);
  command.option("--scale", "S", a->scales, "Scale of a chain; repeatable (default: the scenario's, or 100, 300, 1000)")
      .repeatable();
  return [a] { return run_compare(*a); };
}
