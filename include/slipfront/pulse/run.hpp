#pragma once
/// \file
/// One pulse run: a problem, the times to look at it, and what was seen so far. Can be saved at any step and continued
/// to the same bits.

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "slipfront/output/self_check.hpp"
#include "slipfront/output/snapshot.hpp"
#include "slipfront/pulse/observe.hpp"
#include "slipfront/step_budget.hpp"

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
  /// The steps that it may take. `go` ends with a NumericsError when they are used up.
  const StepBudget& budget() const { return budget_; }
  /// Wall time that the steps have taken, without laying cells and outputs.
  double stepping_seconds() const { return stepping_seconds_; }
  /// May be saved even after a NumericsError: a step that fails changes nothing.
  bool can_checkpoint() const { return true; }
  bool finished() const { return snapshots_.size() == schedule_.times.size(); }
  /// What is amiss or doubtful in the results so far, a sentence each: invariants that do not hold (slip at x = 0
  /// against the integral of the slip velocity there, energy that appears from nothing, the number of dislocations) and
  /// streams that cross. Above 1 % `go` ends with a NumericsError that says so.
  std::vector<std::string> warnings() const;
  /// Slip at x = 0 by the two routes that should agree. Nothing where x = 0 is not within the domain or the run is too
  /// short to tell.
  struct SlipTwice {
    double by_place;     ///< from where the dislocations are
    double by_velocity;  ///< the integral of the slip velocity
    double sampling;     ///< how far the integral may be off for the samples that it is made of
    double of_velocity;  ///< and for what the slip velocity is in the cells around
    /// Their difference, as far as it does not come from sampling or is no more than the cells around leave open.
    double error() const;
  };
  std::optional<SlipTwice> slip_twice() const;
  /// The state of the solver as bytes, for a checkpoint on the same kind of machine.
  std::string saved() const;

 private:
  void take();
  void sample();
  [[noreturn]] void refuse_more_steps() const;
  output::Findings findings() const;
  /// Largest slip at x = 0 and in the last profile.
  double largest_slip(const Solver::View& view) const;
  /// Slip of the cell at x = 0 where nothing has come farther than a few cells, whose inside is not known well; else 0.
  double unresolved_slip(const Solver::View& view) const;
  /// Largest energy that was moving or dissipated, or that the forcing supplied, at an output time.
  double energy_of_motion() const;
  /// Share of the stored energy that the cells leave open where a contact profile acts: as large a share of the forces
  /// that should balance there does not.
  double contact_doubt() const;
  /// How far the change of the stored energy may be wrong because it is a sum over cells.
  double energy_doubt() const;

  output::Schedule schedule_;
  Solver solver_;
  StepBudget budget_;
  TrailingCharacteristic trailing_characteristic_;
  double stepping_seconds_ = 0;
  StoredEnergy first_energy_{};
  output::SampledIntegral slip_;  ///< at x = 0, by the slip velocity there
  double slip_size_ = 0;          ///< integral of the size of that velocity
  double slip_doubt_ = 0;         ///< integral of how wrong it may be, from what it is in the cells around
  std::vector<output::Snapshot> snapshots_;
  std::optional<output::Findings> final_findings_;  ///< of a run that is finished
};

}  // namespace slipfront::pulse
