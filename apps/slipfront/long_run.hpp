#pragma once

#include <fmt/format.h>

#include <optional>
#include <string>
#include <vector>

#include "commands.hpp"
#include "foundation/ranks.hpp"
#include "interrupts.hpp"
#include "progress.hpp"
#include "record/files/text_file.hpp"
#include "run/run.hpp"
#include "run/summary.hpp"
#include "slipfront/scenario/scenario.hpp"

/// Arguments of the subcommands that run a scenario.
struct ScenarioArguments {
  CommonOptions common;
  std::string scenario, output, resume;
  std::vector<std::string> set, more_set;  ///< values of --set; `more_set` are the further values of one --set
  std::string one_too_many;                ///< a second scenario, which is an error
  bool check = false;
  bool si = false, dimensionless = false;  ///< units of the results; by default those of the scenario
};

/// Adds SCENARIO and --set.
void add_scenario_words(CommandLine& command, ScenarioArguments& arguments);
void add_scenario_options(CommandLine& command, ScenarioArguments& arguments, bool with_resume = true);

/// \throws InputError if no scenario or a second one is given.
void require_one_scenario(const ScenarioArguments& arguments);
/// Reads the scenario, chooses the units of its results, and prints its warnings.
slipfront::scenario::Scenario read_scenario_of(const ScenarioArguments& arguments);
/// All values of --set.
std::vector<std::string> settings_of(const ScenarioArguments& arguments);
/// Chooses the units of the results of a scenario, and prints its warnings.
slipfront::scenario::Scenario prepared(slipfront::scenario::Scenario scenario, const ScenarioArguments& arguments);

/// The words of a progress line, with times in the unit of the results.
ProgressWords progress_words(const slipfront::scenario::Scenario& scenario);

/// The law of friction with its parameters: "slip-weakening friction with strength = 0.08, residual = 0.02".
std::string parameters_in_words(const slipfront::friction::Friction& friction);
/// Prints the summary of a run, with its errors, as a table or as one JSON object on stdout. `summary` is in the units
/// of the model. `warnings`, one sentence each, are in the JSON. Those that `read_scenario_of` has not printed go to
/// stderr. `events` are those of a loaded chain, else null.
void print_summary(const slipfront::scenario::Scenario& scenario, std::vector<slipfront::run::Row> summary,
                   const std::vector<std::string>& warnings, const ScenarioArguments& arguments,
                   const std::vector<slipfront::output::SlipEvent>* events = nullptr);

/// Checks that the output of a run can be written, of about `bytes` bytes. `of_finished`: the run continues
/// that of a finished file. \throws FileError.
void require_output(const ScenarioArguments& arguments, bool of_finished, double bytes);

/// The progress line and the output file of a `pulse` or `chain` run. While this object exists, Ctrl-C interrupts the
/// run.
class LongRun {
 public:
  /// `of_finished`: the run continues that of a finished file. `ranks` are the processes that share the run; null if
  /// there is only this one.
  LongRun(const ScenarioArguments& arguments, const slipfront::scenario::Scenario& scenario, bool of_finished,
          const slipfront::Ranks* ranks);
  /// Options of the run: its output, the checkpoint to resume from, if any, and the time `begun` when the command
  /// began.
  slipfront::run::Options options(std::optional<slipfront::record::Checkpoint> checkpoint, Clock::time_point begun);
  /// Ends the run. If it was interrupted, prints at which time. Returns the exit code.
  int end(bool finished);

 private:
  const ScenarioArguments& a_;
  const slipfront::scenario::Scenario& s_;
  const slipfront::Ranks* ranks_;
  bool first_;
  slipfront::record::Output output_;
  std::optional<WatchInterrupts> watch_;
  std::optional<Progress> progress_;
  double time_ = 0;
};
