#pragma once
/// \file
/// Turns a scenario into a result: plans it, runs or resumes it, and summarizes it. The program, the Python package and
/// sweeps all use this file.

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "foundation/clock.hpp"
#include "foundation/ranks.hpp"
#include "record/files/unfinished.hpp"
#include "record/pulses/pulse_file.hpp"
#include "run/compare.hpp"
#include "run/summary.hpp"
#include "scenario/estimate.hpp"
#include "slipfront/chain/run.hpp"
#include "slipfront/pulse/run.hpp"
#include "slipfront/scenario/scenario.hpp"

namespace slipfront::run {

/// How to run a scenario.
struct Options {
  record::Output output = {};                         ///< by default none
  std::optional<record::Checkpoint> checkpoint = {};  ///< state to resume from, read by checkpoint_of
  int threads = 1;                                    ///< threads of a chain, or of the lines of a plane
  const Ranks* ranks = nullptr;                       ///< processes that share them, if any; all must make each call
  /// A function that the run calls after each step with its time and number of steps. Return true to stop the run. If
  /// it is null, the run continues to its end.
  std::function<bool(double time, long steps)> after_step = {};
  Clock::time_point begun = Clock::now();  ///< wall_seconds are counted from this time
};

/// Chooses the units of the results of a scenario. `in_si` is what the user asks for; by default results are in SI
/// units if the scenario has values in SI units. Defaults for constants of the rock add a warning. \throws InputError
/// if the user asks for SI units and [medium] lacks a constant; without that request, this is a warning.
void choose_units(scenario::Scenario& scenario, std::optional<bool> in_si);

/// The metadata for the file of a run of `command`.
record::PulseMetadata metadata_of(const scenario::Scenario& scenario, const std::string& command,
                                  const std::vector<double>& x_edges, const std::vector<double>& scales = {});

/// A problem to solve, its output times, and the memory and disk that it needs. A plan has been checked, so errors
/// appear before the work.
struct PulsePlan {
  pulse::Problem problem;
  output::Schedule schedule;
  scenario::Estimate need;
  std::string file;  ///< the file of the scenario, which errors name
};
struct ChainPlan {
  chain::ScaledProblem chain;
  output::Schedule schedule;
  scenario::Estimate need;
  std::string file;  ///< the file of the scenario, which errors name
};

/// \throws InputError if `output` is the scenario file or one of its tables (record::require_other_file).
void require_inputs_kept(const scenario::Scenario& scenario, const std::string& output);

/// Plans a pulse run. \throws InputError.
PulsePlan plan_pulse(const scenario::Scenario& scenario);
/// Plans a chain run. If several processes share the chain, `share_of_machine` is the part on this machine. \throws
/// InputError.
ChainPlan plan_chain(const scenario::Scenario& scenario, double share_of_machine = 1);

/// Reads the state from which a planned run continues, of an unfinished or a finished run. The scenario is that of the
/// file, or the same with a later time.end and with other output times from the end of the file on. The results are
/// then those of one run to the later end, to the last bit. Snapshots that such a run would not have are left out.
/// \throws FileError; InputError if the file is from another scenario or version, if the end is earlier, or if time.end
/// decides how the run begins.
record::Checkpoint checkpoint_of(const std::string& path, const scenario::Scenario& scenario, const PulsePlan& plan);
record::Checkpoint checkpoint_of(const std::string& path, const scenario::Scenario& scenario, const ChainPlan& plan,
                                 double share_of_machine = 1);

/// The output of a run that writes to `output`, or else to the file `resume` from which it resumes. Both may be empty.
/// If that file is finished (`of_finished`), the run must not lose its result: it replaces it at its end only. \throws
/// FileError.
record::Output output_of(const std::string& output, const std::string& resume, bool of_finished);

/// The result of a run. The summary is empty unless the run is finished.
template <class Run>
struct Result {
  std::unique_ptr<Run> run;
  record::PulseMetadata metadata;  ///< includes the warnings of a finished run
  std::vector<Row> summary = {};   ///< in the units of the model
  bool finished() const { return run->finished(); }
};

/// Begins a planned run, or resumes it, and takes no step. It refuses all that a run refuses at its start. \throws
/// InputError, NumericsError.
std::unique_ptr<pulse::Run> begin(const PulsePlan& plan, const Options& options);
std::unique_ptr<chain::Run> begin(const ChainPlan& plan, const Options& options);

/// Runs a pulse or a chain. \throws NumericsError, after writing the results so far; InputError, FileError.
Result<pulse::Run> pulse(const scenario::Scenario& scenario, const PulsePlan& plan, const Options& options);
Result<chain::Run> chain(const scenario::Scenario& scenario, const ChainPlan& plan, const Options& options);

/// Runs a comparison, and writes each level when it is finished. `levels` gets the finished levels. `scales` are those
/// that the user stated. Returns whether all levels are finished. \throws as run_levels, FileError.
bool compare(const scenario::Scenario& scenario, const Comparison& comparison, const std::vector<double>& scales,
             const record::Output& output, int threads, std::vector<Level>& levels,
             const std::function<void()>& next_level,
             const std::function<bool(const std::string& level, double time, long steps)>& after_step);

}  // namespace slipfront::run
