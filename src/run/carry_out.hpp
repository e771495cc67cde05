#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "foundation/clock.hpp"
#include "foundation/ranks.hpp"
#include "record/files/unfinished.hpp"
#include "record/pulses/pulse_file.hpp"
#include "slipfront/error.hpp"

namespace slipfront::run {

/// Where a run is written to, and by whom.
struct CheckpointOptions {
  record::Output output;
  record::PulseMetadata metadata;
  double disk = 0;               ///< bytes that the file will need, about
  bool resumed = false;          ///< what the run went on from is in a file
  const Ranks* ranks = nullptr;  ///< that share the run, if any: all of them call
};

/// Appends what a finished run reports to what was known of its scenario.
inline void add_warnings(const std::vector<std::string>& of_run, record::PulseMetadata& metadata) {
  metadata.warnings.insert(metadata.warnings.end(), of_run.begin(), of_run.end());
}

/// Writes a run to its output, whole: as unfinished until it has ended.
template <class Run>
class Checkpoints {
 public:
  Checkpoints(const Run& run, const CheckpointOptions& options) : run_(run), options_(options) {}

  /// A checkpoint is the whole file: writing it must stay a small part of the work.
  bool due() const {
    return options_.output.wanted() &&
           any(is_first() && seconds_since(written_) > 0.05 && seconds_since(written_) > 20 * cost_);
  }
  /// What one rank wants, all do.
  bool any(bool mine) const { return options_.ranks ? options_.ranks->any(mine) : mine; }

  void require_disk_space() const {
    if (options_.output.wanted())
      on_first([&] { record::require_disk_space(options_.output.finished(), options_.disk); });
  }

  void write() {
    if (!options_.output.wanted()) return;
    const auto begun = Clock::now();
    const std::string state = run_.saved();  // ranks send their parts to the first
    record::PulseMetadata metadata = options_.metadata;
    if constexpr (requires { run_.events(); }) metadata.events = run_.events();
    if (run_.finished()) add_warnings(run_.warnings(), metadata);  // which asks all ranks
    on_first([&] {
      const record::Output& output = options_.output;
      record::write_pulse(run_.finished() ? output.finished() : output.unfinished(), metadata, run_.snapshots(), state,
                          run_.finished());
      if (run_.finished()) output.clear();
    });
    cost_ = seconds_since(begun);
    written_ = Clock::now();
  }

 private:
  bool is_first() const { return !options_.ranks || options_.ranks->rank() == 0; }
  /// On the first rank; if it throws, all do.
  template <class Work>
  void on_first(const Work& work) const {
    const auto mine = [&] { is_first() ? work() : void(); };
    options_.ranks ? options_.ranks->together(mine) : mine();
  }

  const Run& run_;
  const CheckpointOptions& options_;
  Clock::time_point written_ = Clock::now();
  double cost_ = 0;  ///< seconds of the last one
};

/// Carries `run` on until its end or until `after_step` says to stop, and writes it: at the start (a path that cannot
/// be written, or a disk too small, is known before the work), now and then, and at the end, wherever that is. What
/// stands at the output is replaced at the end of the run alone. Returns whether the end was reached. \throws
/// NumericsError, after what was computed has been written; FileError.
template <class Run>
bool carry_out(Run& run, const CheckpointOptions& options, const std::function<bool()>& after_step) {
  Checkpoints<Run> checkpoints(run, options);
  checkpoints.require_disk_space();
  if (!options.resumed && !options.output.replaces()) checkpoints.write();
  bool reached = false;
  try {
    reached = run.go([&] {
      const bool stop = after_step();
      if (checkpoints.due()) checkpoints.write();
      return checkpoints.any(stop);
    });
  } catch (const NumericsError& error) {  // the run stands at its last good step, or the last checkpoint does
    if (run.can_checkpoint()) checkpoints.write();
    std::error_code none;
    if (options.output.wanted() && std::filesystem::exists(options.output.unfinished(), none))
      throw NumericsError(std::string(error.what()) + "; what was computed is in " + options.output.unfinished());
    throw;
  }
  checkpoints.write();
  return reached;
}

}  // namespace slipfront::run
