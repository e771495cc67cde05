#pragma once

#include <fmt/format.h>

#include <string>
#include <vector>

#include "commands.hpp"
#include "interrupts.hpp"
#include "progress.hpp"
#include "slipfront/chain/ranks.hpp"
#include "slipfront/record/carry_out.hpp"
#include "slipfront/record/table_file.hpp"
#include "slipfront/record/text_file.hpp"
#include "slipfront/scenario/scenario.hpp"
#include "slipfront/setup/summary.hpp"

/// What the subcommands that run a scenario have in common.
struct ScenarioArguments {
  CommonOptions common;
  std::string scenario, output, resume;
  std::vector<std::string> set, more_set;  ///< the second: behind one --set
  std::string one_too_many;                ///< a second scenario
  bool check = false;
};

void add_scenario_options(CLI::App& command, ScenarioArguments& arguments, bool with_resume = true);

/// The scenario; its warnings are said.
slipfront::scenario::Scenario read_scenario_of(const ScenarioArguments& arguments);

/// The checkpoint to resume from. \throws InputError if another scenario or version wrote it.
slipfront::record::Checkpoint checkpoint_of(const ScenarioArguments& arguments,
                                            const slipfront::scenario::Scenario& scenario);

/// A number as JSON, null where there is none.
std::string json_number(double value);
/// What a run is summed up by, as a table or one JSON object on stdout; its warnings, a sentence each, on stderr and in
/// the JSON. `errors`: of each row, NaN where there is none; empty: none at all.
void print_summary(const std::string& title, const std::vector<slipfront::setup::SummaryValue>& summary,
                   const std::vector<double>& errors, const std::vector<std::string>& warnings,
                   const ScenarioArguments& arguments);

/// Carries a run (pulse or chain) to its end with progress, checkpoints and heed to Ctrl-C. The file will have some
/// `disk` bytes; `time` and `steps` tell where the run is. Returns the exit code.
template <class Run, class Time, class Steps>
int carry_out(Run& run, const ScenarioArguments& a, const slipfront::scenario::Scenario& s, const std::string& command,
              double disk, Time&& time, Steps&& steps) {
  using namespace slipfront;
  const bool first = the_ranks->rank() == 0;
  // The history is that of the run, not of how it was interrupted and resumed: equal runs make equal files.
  const chain::Ranks* const ranks = command == "chain" && the_ranks->size() > 1 ? the_ranks : nullptr;
  record::Output output;
  const auto open = [&] { output = record::Output(a.output.empty() ? a.resume : a.output, a.resume); };
  ranks ? ranks->together(open) : open();
  const record::Keeping keeping{.output = output,
                                .metadata = {s.title, s.text, SLIPFRONT_VERSION, scenario::command_line(s, command),
                                             run.schedule().x_edges, s.output.variables},
                                .disk = disk,
                                .resumed = !a.resume.empty(),
                                .ranks = ranks};
  if (keeping.output.wanted())
    interrupted_means("; what was written last stays: go on with " + keeping.output.how_to_resume());
  const WatchInterrupts watch(!first);
  bool reached = false;
  {
    Progress progress(s.end, first && !a.common.quiet);
    progress.from(time(), steps());
    reached = record::carry_out(run, keeping, [&] {
      progress.at(time(), steps());
      return interrupted_by_user();
    });
  }
  if (reached) return exit_done;
  if (first)
    complain(keeping.output.wanted()
                 ? fmt::format("interrupted at t = {:.6g}; go on with {}", time(), keeping.output.how_to_resume())
                 : "interrupted; no checkpoint, as there is no -o FILE");
  return exit_interrupted;
}
