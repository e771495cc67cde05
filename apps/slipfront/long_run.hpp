#pragma once

#include <fmt/format.h>

#include <functional>
#include <string>
#include <vector>

#include "commands.hpp"
#include "progress.hpp"
#include "runs/run.hpp"
#include "slipfront/scenario/scenario.hpp"
#include "system/ranks.hpp"

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

/// A duration in words: "about 40 s".
std::string in_words(double seconds);

/// The law of friction with its parameters: "slip-weakening friction with strength = 0.08, residual = 0.02".
std::string parameters_in_words(const slipfront::friction::Friction& friction);
/// Plans a run, and carries it out or, with --check, prints `in_words`: what the scenario "would ...". The processes of
/// mpirun share the run if its solver follows every dislocation. `begun` is the time when the command began. Returns
/// the exit code.
int plan_and_run(
    const ScenarioArguments& arguments, Clock::time_point begun, const std::function<slipfront::run::Plan()>& make_plan,
    const std::function<std::string(const slipfront::run::Plan&, const slipfront::output::Run&)>& in_words);
