#pragma once
/// \file
/// Turns a scenario into a result: plans it, runs or resumes it, and summarizes it. The program, the Python package and
/// sweeps all use this file.

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "runs/record/arrays.hpp"
#include "runs/record/run_file.hpp"
#include "runs/summary.hpp"
#include "scenario/estimate.hpp"
#include "scenario/solver_errors.hpp"
#include "slipfront/averages/pulse/run.hpp"
#include "slipfront/lattice/chain/run.hpp"
#include "slipfront/lattice/plane/run.hpp"
#include "slipfront/scenario/problem.hpp"
#include "slipfront/scenario/scenario.hpp"
#include "system/files/whole_file.hpp"
#include "system/machine.hpp"
#include "system/ranks.hpp"

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

/// The metadata for a file, in this format, of a run of `command`.
record::RunMetadata metadata_of(const scenario::Scenario& scenario, const char* format, const std::string& command,
                                const std::vector<double>& scales = {});

struct FaultOnPlane;

/// A run that has been planned and checked, so that errors appear before the work. It must outlive the run.
struct Plan {
  scenario::SolverKind solver = scenario::SolverKind::pulse;
  scenario::Scenario scenario = {};
  double share_of_machine = 1;   ///< the part of the chain on this machine, if several processes share it
  scenario::Estimate need = {};  ///< on a plane only of the disk
  // The problem of the solver, and its output times, on a line or on a plane. The others are empty.
  pulse::Problem pulse = {};
  chain::ScaledProblem chain = {};
  output::Schedule on_line = {};
  plane::Schedule on_plane = {};
  /// The finite-fault model from which the scenario was made, and with which the results are compared; null: none.
  std::shared_ptr<const FaultOnPlane> model = {};

  bool is_on_plane() const { return solver != scenario::SolverKind::pulse && solver != scenario::SolverKind::chain; }
  const std::vector<double>& times() const { return is_on_plane() ? on_plane.times : on_line.times; }
  const char* format() const { return is_on_plane() ? record::plane_format : record::pulse_format; }
};
/// \throws InputError.
Plan plan_of(scenario::SolverKind solver, scenario::Scenario scenario, double share_of_machine = 1);

/// \throws InputError if `output` is the scenario file or one of its tables (record::require_other_file).
void require_inputs_kept(const scenario::Scenario& scenario, const std::string& output);

/// Reads the state from which a planned run continues, of an unfinished or a finished run. The scenario is that of the
/// file, or the same with a later time.end and with other output times from the end of the file on. The results are
/// then those of one run to the later end, to the last bit. Snapshots that such a run would not have are left out.
/// \throws FileError; InputError if the file is from another scenario or version, if the end is earlier, or if time.end
/// decides how the run begins.
record::Checkpoint checkpoint_of(const std::string& path, const Plan& plan);

/// The output of a run that writes to `output`, or else to the file `resume` from which it resumes. Both may be empty.
/// If that file is finished (`of_finished`), the run must not lose its result: it replaces it at its end only. \throws
/// FileError.
record::Output output_of(const std::string& output, const std::string& resume, bool of_finished);

/// A run by any solver.
struct Result {
  std::unique_ptr<output::Run> run;
  record::RunMetadata metadata;   ///< includes the warnings of a finished run
  std::vector<Row> summary = {};  ///< numbers of a finished run, in the units of the model

  // Functions of the run and its plan, to which they refer.
  std::function<std::vector<record::Array>()> arrays = {};                   ///< the variables of the file
  std::function<std::vector<Row>(const output::Spent& spent)> numbers = {};  ///< (all ranks) the summary
  std::function<const std::vector<output::Snapshot>&()> snapshots = {};      ///< null on a plane
  std::function<std::vector<output::SlipEvent>()> events = {};               ///< null unless a chain is loaded
  /// Sets the errors of the summary, by coarser runs (run/errors.hpp). Returns warnings. Null: they are set, or there
  /// are none.
  std::function<std::vector<std::string>(std::vector<Row>& summary, const std::function<bool()>& interrupted)>
      add_errors = {};
  double cost_of_errors = 0;  ///< about how long `add_errors` takes, as a part of the time of the run

  bool finished() const { return run->finished(); }
};

/// Begins a planned run, or resumes it, and takes no step. It refuses all that a run refuses at its start. \throws
/// InputError, NumericsError.
Result begin(const Plan& plan, const Options& options);

/// About how long a run takes.
struct Duration {
  double seconds;    ///< from Options::begun to the end, with the errors of the results; NaN if it is not known
  double of_a_step;  ///< seconds of each of the first steps
};
/// (all ranks) Advances a run, which must not have taken a step since `begin`, for `most` seconds or a little longer.
/// It writes nothing. If the run has not ended by then, we extrapolate. The number of implicit steps depends on slip
/// events, so it is known only if the first ones have come some way. \throws NumericsError if the run fails.
Duration expected_duration(const Result& begun, const Plan& plan, const Options& options, double most = 0.5);

/// Continues a run until its end, or until `options.after_step` returns true. It writes the file at the start, so that
/// a bad path or a full disk fails before the work. It writes again from time to time, and when the run stops. An
/// existing file at the output is replaced only at the end of the run. \throws NumericsError, after writing the results
/// so far; InputError, FileError.
Result carry_out(const Plan& plan, const Options& options);

}  // namespace slipfront::run
