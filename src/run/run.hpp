#pragma once
/// \file
/// The one way from a scenario to a result, for the program, the Python package and sweeps: plan, run or resume, sum
/// up.

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "foundation/clock.hpp"
#include "foundation/ranks.hpp"
#include "record/files/unfinished.hpp"
#include "record/pulses/pulse_file.hpp"
#include "run/summary.hpp"
#include "setup/estimate.hpp"
#include "slipfront/chain/run.hpp"
#include "slipfront/pulse/run.hpp"
#include "slipfront/scenario/scenario.hpp"
#include "slipfront/setup/compare.hpp"

namespace slipfront::run {

/// How a run is carried out.
struct Options {
  record::Output output = {};                         ///< default: none
  std::optional<record::Checkpoint> checkpoint = {};  ///< to go on from, as checkpoint_of reads it
  int threads = 1;                                    ///< of a chain
  const Ranks* ranks = nullptr;                       ///< processes that share a chain, if any: all of them call
  /// Called after each step with where the run stands; returning true stops it. Null: it goes on to its end.
  std::function<bool(double time, long steps)> after_step = {};
  Clock::time_point begun = Clock::now();  ///< wall_seconds count from here
};

/// The state of an unfinished run in a file. \throws FileError, InputError if another scenario or version wrote it.
record::Checkpoint checkpoint_of(const std::string& path, const scenario::Scenario& scenario);

/// What a file says of a run of `command`.
record::PulseMetadata metadata_of(const scenario::Scenario& scenario, const std::string& command,
                                  const std::vector<double>& x_edges, const std::vector<double>& scales = {});

/// What there is to run, and what that needs. Problems and schedules are checked: what is wrong is known before the
/// work.
struct PulsePlan {
  pulse::Problem problem;
  output::Schedule schedule;
  setup::Estimate need;
};
struct ChainPlan {
  chain::ScaledProblem chain;
  output::Schedule schedule;
  setup::Estimate need;
};

/// \throws InputError.
PulsePlan plan_pulse(const scenario::Scenario& scenario);
/// `share_of_machine`: of a chain that several processes share, what is on this machine. \throws InputError.
ChainPlan plan_chain(const scenario::Scenario& scenario, double share_of_machine = 1);

/// What came of a run. The summary is empty unless it is finished.
template <class Run>
struct Result {
  std::unique_ptr<Run> run;
  record::PulseMetadata metadata;  ///< with the warnings of a finished run
  std::vector<SummaryValue> summary = {};
  bool finished() const { return run->finished(); }
};

/// \throws NumericsError, after what was computed has been written; InputError, FileError.
Result<pulse::Run> pulse(const scenario::Scenario& scenario, const PulsePlan& plan, const Options& options);
Result<chain::Run> chain(const scenario::Scenario& scenario, const ChainPlan& plan, const Options& options);

/// Runs a comparison and writes each level when it is done. `levels` holds those that were; `scales` are as given by
/// the user. Returns whether all were. \throws as setup::run_levels, FileError.
bool compare(const scenario::Scenario& scenario, const setup::Comparison& comparison, const std::vector<double>& scales,
             const record::Output& output, int threads, std::vector<setup::Level>& levels,
             const std::function<void()>& next_level,
             const std::function<bool(const std::string& level, double time, long steps)>& after_step);

}  // namespace slipfront::run
