#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "foundation/clock.hpp"
#include "record/files/unfinished.hpp"
#include "record/pulses/pulse_file.hpp"
#include "run/run.hpp"
#include "scenario/solver_errors.hpp"
#include "slipfront/error.hpp"

namespace slipfront::run {

/// Appends the warnings of a finished run to those of its scenario.
inline void add_warnings(const std::vector<std::string>& of_run, record::PulseMetadata& metadata) {
  for (const std::string& warning : of_run) metadata.warnings.push_back(scenario::in_results(warning, metadata.units));
}

/// Writes a run and its saved state to a file.
using WriteRun =
    std::function<void(const std::string& path, const record::PulseMetadata& metadata, const std::string& state)>;

/// Writes the whole run to its output with `write_run`. Until the run has ended, the file is marked as unfinished.
template <class Run>
class Checkpoints {
 public:
  Checkpoints(const Run& run, const Options& options, const record::PulseMetadata& metadata, const WriteRun& write_run)
      : run_(run), options_(options), metadata_(metadata), write_run_(write_run) {}

  /// Whether it is time for a checkpoint. Each writes the whole file, so we limit writing to a small part of the work.
  bool due() const {
    return options_.output.wanted() &&
           any(is_first() && seconds_since(written_) > 0.05 && seconds_since(written_) > 20 * cost_);
  }
  /// Whether `mine` is true on any rank.
  bool any(bool mine) const { return options_.ranks ? options_.ranks->any(mine) : mine; }

  /// `bytes` is the approximate size of the file.
  void require_disk_space(double bytes) const {
    if (options_.output.wanted()) on_first([&] { record::require_disk_space(options_.output.finished(), bytes); });
  }

  /// Throws the error of the run, with the file of what was computed. All ranks throw it together.
  void fail(std::string why) const {
    std::error_code none;
    if (options_.output.wanted() && std::filesystem::exists(options_.output.unfinished(), none))
      why += "; what was computed is in " + options_.output.unfinished();
    const auto fails = [&] { throw NumericsError(why); };
    options_.ranks ? options_.ranks->together(fails) : fails();
  }

  void write() {
    if (!options_.output.wanted()) return;
    const auto begun = Clock::now();
    const std::string state = run_.saved();  // all ranks send their parts to the first rank
    record::PulseMetadata metadata = metadata_;
    if (run_.finished()) add_warnings(run_.warnings(), metadata);  // warnings() needs all ranks
    on_first([&] {
      const record::Output& output = options_.output;
      write_run_(run_.finished() ? output.finished() : output.unfinished(), metadata, state);
      if (run_.finished()) output.clear();
    });
    cost_ = seconds_since(begun);
    written_ = Clock::now();
  }

 private:
  bool is_first() const { return !options_.ranks || options_.ranks->rank() == 0; }
  /// Does `work` on the first rank. If it throws, all ranks throw.
  template <class Work>
  void on_first(const Work& work) const {
    const auto mine = [&] { is_first() ? work() : void(); };
    options_.ranks ? options_.ranks->together(mine) : mine();
  }

  const Run& run_;
  const Options& options_;
  const record::PulseMetadata& metadata_;
  const WriteRun& write_run_;
  Clock::time_point written_ = Clock::now();
  double cost_ = 0;  ///< seconds that the last checkpoint took
};

/// Continues the run of `result` until its end, or until `options.after_step` returns true. It writes the file, of
/// about `bytes`, at the start, so that a bad path or a full disk fails before the work. It writes again from time to
/// time, and when the run stops. An existing file at the output is replaced only at the end of the run. Returns whether
/// the run has reached its end; then the metadata have its warnings. \throws NumericsError, after writing the results
/// so far; FileError.
template <class Result>
bool carry_out(Result& result, const Options& options, double bytes, const WriteRun& write_run) {
  auto& run = *result.run;
  Checkpoints checkpoints(run, options, result.metadata, write_run);
  checkpoints.require_disk_space(bytes);
  if (!options.checkpoint && !options.output.replaces()) checkpoints.write();
  bool reached = false;
  try {
    reached = run.go([&] {
      const bool stop = options.after_step && options.after_step(run.time(), run.steps());
      if (checkpoints.due()) checkpoints.write();
      return checkpoints.any(stop);
    });
  } catch (const NumericsError& error) {  // the run or its last checkpoint has a valid state
    if (run.can_checkpoint()) checkpoints.write();
    checkpoints.fail(scenario::in_results(error.what(), result.metadata.units));
  }
  checkpoints.write();
  if (reached) add_warnings(run.warnings(), result.metadata);  // asks all ranks
  return reached;
}

}  // namespace slipfront::run
