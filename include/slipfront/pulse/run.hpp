#pragma once
/// \file
/// One pulse run: a problem, the times to look at it, and what was seen so far. Can be saved at any step and continued
/// to the same bits.

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "slipfront/output/snapshot.hpp"
#include "slipfront/pulse/problem.hpp"

namespace slipfront {
class StepBudget;
}

namespace slipfront::pulse {

class Solver;
struct SlipTwice;

class Run {
 public:
  Run(Problem problem, output::Schedule schedule);
  /// Continues a saved run of the same problem and schedule. \throws InputError if it is of another.
  Run(Problem problem, output::Schedule schedule, std::string_view saved, std::vector<output::Snapshot> snapshots);
  ~Run();
  Run(Run&&) noexcept;
  Run& operator=(Run&&) noexcept;

  /// Advances until the end, or until `interrupted`, asked after every step, returns true; the run may be saved from
  /// there. Returns whether the end was reached. \throws NumericsError where the solver gives up, where the steps that
  /// the run may take are used up, or where results miss an invariant by more than 1 %.
  bool go(const std::function<bool()>& interrupted = {});

  const Solver& solver() const;
  const output::Schedule& schedule() const;
  const std::vector<output::Snapshot>& snapshots() const;
  /// The steps that it may take.
  const StepBudget& budget() const;
  /// Wall time that the steps have taken, without the time for the cells at t = 0 and for outputs.
  double stepping_seconds() const;
  /// A run may be saved even after a NumericsError: a step that fails changes nothing.
  bool can_checkpoint() const { return true; }
  bool finished() const;
  /// Sentences about what is wrong or doubtful in the results so far.
  std::vector<std::string> warnings() const;
  /// Slip at x = 0 by the two routes that should agree (pulse/checks/slip_record.hpp). Nothing where x = 0 is not
  /// within the domain or the run is too short to tell.
  std::optional<SlipTwice> slip_twice() const;
  /// The state of the run as bytes, for a checkpoint on the same kind of machine.
  std::string saved() const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace slipfront::pulse
