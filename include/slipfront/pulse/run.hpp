#pragma once
/// \file
/// One pulse run: a problem, the times to look at it, and what was seen so far. Can be saved at any step and continued
/// to the same bits.

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "slipfront/output/snapshot.hpp"
#include "slipfront/pulse/observe.hpp"

namespace slipfront::pulse {

class Run {
 public:
  Run(Problem problem, output::Schedule schedule);
  /// Continues a saved run of the same problem and schedule. \throws InputError if it is of another.
  Run(Problem problem, output::Schedule schedule, std::string_view saved, std::vector<output::Snapshot> snapshots);

  /// Goes on until the end or until `interrupted`, asked after every step, says so; the run may be saved from there.
  /// Returns whether the end was reached.
  bool go(const std::function<bool()>& interrupted = {});

  const Solver& solver() const { return solver_; }
  const output::Schedule& schedule() const { return schedule_; }
  const std::vector<output::Snapshot>& snapshots() const { return snapshots_; }
  /// Wall time that the steps have taken, without laying cells and outputs.
  double stepping_seconds() const { return stepping_seconds_; }
  /// May be saved even after a NumericsError: a step that fails changes nothing.
  bool can_checkpoint() const { return true; }
  bool finished() const { return snapshots_.size() == schedule_.times.size(); }
  /// What is amiss or doubtful in the results so far, a sentence each: invariants that do not hold (slip at x = 0
  /// against the integral of the slip velocity there, energy that appears from nothing, the number of dislocations) and
  /// streams that cross. Above 1 % `go` ends with a NumericsError that says so.
  std::vector<std::string> warnings() const;
  /// The state of the solver as bytes, for a checkpoint on the same kind of machine.
  std::string saved() const;

 private:
  void take();
  void sample();
  struct Findings;
  Findings findings() const;
  void refuse_wrong_results() const;

  output::Schedule schedule_;
  Solver solver_;
  TrailingCharacteristic trailing_characteristic_;
  double stepping_seconds_ = 0;
  double first_energy_ = 0;
  /// Integral of the slip velocity at x = 0 over samples, and over every other of them.
  struct Passed {
    double time = 0, velocity = 0, slip = 0, way = 0;  ///< way: integral of its size
    double early_time = 0, early_velocity = 0, coarse_slip = 0;
    double spread = 0;  ///< sum of squares of what each sample leaves open
    double doubt = 0;   ///< integral of how wrong the velocity may be, from what it is in the cells around
    long samples = 0;
  };
  Passed passed_;
  std::vector<output::Snapshot> snapshots_;
};

}  // namespace slipfront::pulse
