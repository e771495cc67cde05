#pragma once
/// \file
/// One pulse run: a problem, the times to look at it, and what was seen so far. Can be saved at any step and continued
/// to the same bits.

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "slipfront/pulse/observe.hpp"

namespace slipfront::pulse {

class Run {
 public:
  Run(Problem problem, Schedule schedule);
  /// Continues a saved run of the same problem and schedule. \throws InputError if it is of another.
  Run(Problem problem, Schedule schedule, std::string_view saved, std::vector<Snapshot> snapshots);

  /// Goes on until the end or until `interrupted`, asked after every step, says so; the run may be saved from there.
  /// Returns whether the end was reached.
  bool go(const std::function<bool()>& interrupted = {});

  const Solver& solver() const { return solver_; }
  const Schedule& schedule() const { return schedule_; }
  const std::vector<Snapshot>& snapshots() const { return snapshots_; }
  /// Wall time that the steps have taken, without laying cells and outputs.
  double stepping_seconds() const { return stepping_seconds_; }
  bool good() const { return true; }  ///< may be saved even after a NumericsError: a step that fails changes nothing
  bool finished() const { return snapshots_.size() == schedule_.times.size(); }
  /// The state of the solver as bytes, for a checkpoint on the same kind of machine.
  std::string saved() const;

 private:
  void take();

  Schedule schedule_;
  Solver solver_;
  TrailingFront trailing_front_;
  double stepping_seconds_ = 0;
  std::vector<Snapshot> snapshots_;
};

}  // namespace slipfront::pulse
