#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "foundation/clock.hpp"
#include "foundation/ranks.hpp"
#include "record/pulse_file.hpp"
#include "record/unfinished.hpp"
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

/// Carries `run` on until its end or until `after_step` says to stop, and writes it: at the start (a path that cannot
/// be written, or a disk too small, is known before the work), now and then, and at the end, wherever that is. What
/// stands at the output is replaced at the end of the run alone. Returns whether the end was reached. \throws
/// NumericsError, after what was computed has been written; FileError.
template <class Run>
bool carry_out(Run& run, const CheckpointOptions& options, const std::function<bool()>& after_step) {
  const bool first = !options.ranks || options.ranks->rank() == 0;
  const auto agreed = [&](bool mine) { return options.ranks ? options.ranks->any(mine) : mine; };
  auto written = Clock::now();
  double cost = 0;
  const auto write = [&] {
    if (!options.output.wanted()) return;
    const auto begun = Clock::now();
    const std::string state = run.saved();  // ranks send their parts to the first
    record::PulseMetadata metadata = options.metadata;
    if constexpr (requires { run.events(); }) metadata.events = run.events();
    if (run.finished()) add_warnings(run.warnings(), metadata);  // which asks all ranks
    const auto put_down = [&] {
      if (!first) return;
      const record::Output& output = options.output;
      record::write_pulse(run.finished() ? output.finished() : output.unfinished(), metadata, run.snapshots(), state,
                          run.finished());
      if (run.finished()) output.clear();
    };
    if (options.ranks)
      options.ranks->together(put_down);
    else
      put_down();
    cost = seconds_since(begun);
    written = Clock::now();
  };
  if (options.output.wanted()) {
    const auto space = [&] { first ? record::require_disk_space(options.output.finished(), options.disk) : void(); };
    options.ranks ? options.ranks->together(space) : space();
  }
  if (!options.resumed && !options.output.replaces()) write();
  bool reached = false;
  try {
    reached = run.go([&] {
      const bool stop = after_step();
      // A checkpoint is the whole file: writing it must stay a small part of the work.
      if (options.output.wanted() &&
          agreed(first && seconds_since(written) > 0.05 && seconds_since(written) > 20 * cost))
        write();
      return agreed(stop);
    });
  } catch (const NumericsError& error) {  // the run stands at its last good step, or the last checkpoint does
    if (run.can_checkpoint()) write();
    std::error_code none;
    if (options.output.wanted() && std::filesystem::exists(options.output.unfinished(), none))
      throw NumericsError(std::string(error.what()) + "; what was computed is in " + options.output.unfinished());
    throw;
  }
  write();
  return reached;
}

}  // namespace slipfront::run
