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
#include "record/netcdf/table_file.hpp"
#include "run/run.hpp"
#include "run/summary.hpp"
#include "slipfront/scenario/scenario.hpp"

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

/// The law of friction with its parameters: "slip-weakening friction with strength = 0.08, residual = 0.02".
std::string parameters_in_words(const slipfront::friction::Friction& friction);
/// Prints the summary of a run as a table or as one JSON object on stdout. `warnings`, a sentence each, are in the
/// JSON; those that `read_scenario_of` has not printed go to stderr. `errors`: of each row, NaN where there is none;
/// empty: none at all. `events`: of a loaded chain; else null.
void print_summary(const slipfront::scenario::Scenario& scenario,
                   const std::vector<slipfront::run::SummaryValue>& summary, const std::vector<double>& errors,
                   const std::vector<std::string>& warnings, const ScenarioArguments& arguments,
                   const std::vector<slipfront::output::SlipEvent>* events = nullptr);

/// A run (of pulse or chain) of the program: its progress, its output, and heed to Ctrl-C while this lives.
class LongRun {
 public:
  /// `ranks` that share the run; null: none.
  LongRun(const ScenarioArguments& arguments, const slipfront::scenario::Scenario& scenario,
          const slipfront::Ranks* ranks);
  /// How to carry the run out: with its output, from the checkpoint if any. `begun`: when the command was.
  slipfront::run::Options options(std::optional<slipfront::record::Checkpoint> checkpoint, Clock::time_point begun);
  /// After the run; says where it was interrupted. Returns the exit code.
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
