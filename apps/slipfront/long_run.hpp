#pragma once

#include <fmt/format.h>

#include <cmath>
#include <string>
#include <vector>

#include "commands.hpp"
#include "progress.hpp"
#include "slipfront/chain/ranks.hpp"
#include "slipfront/error.hpp"
#include "slipfront/record/pulse_file.hpp"
#include "slipfront/record/table_file.hpp"
#include "slipfront/record/text_file.hpp"
#include "slipfront/scenario/scenario.hpp"

/// What the subcommands that run a scenario have in common.
struct ScenarioArguments {
  CommonOptions common;
  std::string scenario, output, resume;
  std::vector<std::string> set;
  bool check = false;
};

void add_scenario_options(CLI::App& command, ScenarioArguments& arguments, bool with_resume = true);

/// The scenario; its warnings are said.
slipfront::scenario::Scenario read_scenario_of(const ScenarioArguments& arguments);

/// The checkpoint to resume from. \throws InputError if another scenario or version wrote it.
slipfront::record::Checkpoint checkpoint_of(const ScenarioArguments& arguments,
                                            const slipfront::scenario::Scenario& scenario);

/// One line of what a run prints: a key of the contract, its value as JSON, what it is.
struct ResultRow {
  const char* key;
  std::string value;
  const char* meaning;
};
std::string json_number(double value);
void print_rows(const std::string& title, const std::vector<ResultRow>& rows, const ScenarioArguments& arguments);

/// Carries a run (pulse or chain) to its end with progress, checkpoints and heed to Ctrl-C. `time` and `steps` tell
/// where it is. Returns the exit code.
template <class Run, class Time, class Steps>
int carry_out(Run& run, const ScenarioArguments& a, const slipfront::scenario::Scenario& s, const std::string& command,
              Time&& time, Steps&& steps) {
  using namespace slipfront;
  const std::string output = a.output.empty() ? a.resume : a.output;
  // The history is that of the run, not of how it was interrupted and resumed: equal runs make equal files.
  const record::PulseMetadata metadata{
      s.title,           s.text, SLIPFRONT_VERSION, "slipfront " + command + " " + a.scenario, run.schedule().x_edges,
      s.output.variables};
  auto written = Clock::now();
  double cost = 0;
  const bool first = the_ranks->rank() == 0;
  const bool alone = command != "chain" || the_ranks->size() == 1;
  const auto agreed = [&](bool mine) { return alone ? mine : the_ranks->any(mine); };
  const auto write = [&] {
    if (output.empty()) return;
    const auto begun = Clock::now();
    const std::string state = run.saved();  // ranks send their parts to the first
    const auto put_down = [&] {
      if (first) record::write_pulse(output, metadata, run.snapshots(), state, run.finished());
    };
    if (alone)
      put_down();
    else
      the_ranks->together(put_down);
    cost = seconds_since(begun);
    written = Clock::now();
  };
  watch_interrupts();
  if (a.resume.empty()) write();  // a path that cannot be written is known before the work, not after

  bool reached = false;
  {
    Progress progress(s.end, first && !a.common.quiet);
    progress.from(time(), steps());
    const auto after_step = [&] {
      progress.at(time(), steps());
      // A checkpoint is the whole file: writing it must stay a small part of the work.
      if (agreed(first && seconds_since(written) > std::fmax(0.05, 20 * cost))) write();
      return agreed(interrupted_by_user());
    };
    try {
      reached = run.go(after_step);
    } catch (const NumericsError& error) {  // the run stands at its last good step, or the last checkpoint does
      if (run.good()) write();
      if (!output.empty()) throw NumericsError(std::string(error.what()) + "; what was computed is in " + output);
      throw;
    }
  }
  write();
  if (reached) return exit_done;
  if (first)
    complain(output.empty() ? "interrupted; no checkpoint, as there is no -o FILE"
                            : fmt::format("interrupted at t = {:.6g}; go on with --resume {}", time(), output));
  return exit_interrupted;
}
