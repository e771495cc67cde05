#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "foundation/clock.hpp"
#include "foundation/ranks.hpp"
#include "record/files/unfinished.hpp"
#include "record/pulses/pulse_file.hpp"
#include "slipfront/error.hpp"

namespace slipfront::run {

/// The output of a run, and the ranks that write it.
struct CheckpointOptions {
  record::Output output;
  record::PulseMetadata metadata;
  double disk = 0;               ///< approximate number of bytes of the file
  bool resumed = false;          ///< the run was resumed, so its start is in a file already
  const Ranks* ranks = nullptr;  ///< ranks that share the run, if any; all of them must make each call
};

/// Appends the warnings of a finished run to those of its scenario.
inline void add_warnings(const std::vector<std::string>& of_run, record::PulseMetadata& metadata) {
  metadata.warnings.insert(metadata.warnings.end(), of_run.begin(), of_run.end());
}

/// Writes a run and its saved state to a file.
using WriteRun =
    std::function<void(const std::string& path, const record::PulseMetadata& metadata, const std::string& state)>;

/// Writes the whole run to its output, with `write_run` if it is given and else as a pulse. Until the run has ended,
/// the file is marked as unfinished.
template <class Run>
class Checkpoints {
 public:
  Checkpoints(const Run& run, const CheckpointOptions& options, WriteRun write_run)
      : run_(run), options_(options), write_run_(std::move(write_run)) {}

  /// Whether it is time for a checkpoint. Each writes the whole file, so we limit writing to a small part of the work.
  bool due() const {
    return options_.output.wanted() &&
           any(is_first() && seconds_since(written_) > 0.05 && seconds_since(written_) > 20 * cost_);
  }
  /// Whether `mine` is true on any rank.
  bool any(bool mine) const { return options_.ranks ? options_.ranks->any(mine) : mine; }

  void require_disk_space() const {
    if (options_.output.wanted())
      on_first([&] { record::require_disk_space(options_.output.finished(), options_.disk); });
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
    record::PulseMetadata metadata = options_.metadata;
    if constexpr (requires { run_.events(); }) {
      metadata.events = run_.events();
      metadata.fronts = run_.fronts();
    }
    if (run_.finished()) add_warnings(run_.warnings(), metadata);  // warnings() needs all ranks
    on_first([&] {
      const record::Output& output = options_.output;
      const std::string& path = run_.finished() ? output.finished() : output.unfinished();
      if constexpr (requires { run_.maps(); })
        write_run_(path, metadata, state);
      else
        record::write_pulse(path, metadata, run_.snapshots(), state, run_.finished());
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
  const CheckpointOptions& options_;
  WriteRun write_run_;
  Clock::time_point written_ = Clock::now();
  double cost_ = 0;  ///< seconds that the last checkpoint took
};

/// Continues `run` until its end, or until `after_step` returns true. It writes the file at the start, so that a bad
/// path or a full disk fails before the work. It writes again from time to time, and when the run stops. An existing
/// file at the output is replaced only at the end of the run. Returns whether the run has reached its end. \throws
/// NumericsError, after writing the results so far; FileError.
template <class Run>
bool carry_out(Run& run, const CheckpointOptions& options, const std::function<bool()>& after_step,
               const WriteRun& write_run = {}) {
  Checkpoints<Run> checkpoints(run, options, write_run);
  checkpoints.require_disk_space();
  if (!options.resumed && !options.output.replaces()) checkpoints.write();
  bool reached = false;
  try {
    reached = run.go([&] {
      const bool stop = after_step();
      if (checkpoints.due()) checkpoints.write();
      return checkpoints.any(stop);
    });
  } catch (const NumericsError& error) {  // the run or its last checkpoint has a valid state
    if (run.can_checkpoint()) checkpoints.write();
    checkpoints.fail(error.what());
  }
  checkpoints.write();
  return reached;
}

}  // namespace slipfront::run
