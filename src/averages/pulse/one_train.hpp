#pragma once
/// \file
/// One train at each position takes over from many (docs/theory/9_trains.md 9.7).

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "averages/pulse/checks/checks.hpp"
#include "averages/pulse/contours/many_trains.hpp"
#include "averages/pulse/motion.hpp"
#include "averages/pulse/observe/observe.hpp"
#include "averages/pulse/solver.hpp"

namespace slipfront::pulse {

/// One train at each position, by finite volumes (solver.hpp).
class OneTrain : public Motion {
 public:
  explicit OneTrain(Problem problem);

  /// The state in which one train takes over from many.
  struct Start {
    Cells cells;
    double trailing_front;  ///< x of its characteristic; NaN: as at t = 0
    SlipRecord slip;
    std::vector<std::string> warnings;
  };
  OneTrain(Problem problem, Start start);

  const Solver& solver() const { return solver_; }
  const Problem& problem() const override { return solver_.problem(); }
  double time() const override { return solver_.cells().time; }
  long steps() const override { return solver_.cells().steps; }
  bool advance_to(double target, const std::function<bool()>& after_step) override;
  bool aimed_at_target() const override { return solver_.aimed_at_time(); }
  double expected_steps(double duration) const override { return solver_.expected_steps(duration); }
  std::string reason_of_short_steps() const override { return solver_.reason_of_short_steps(); }

  void archive(Archive& a) override;

  output::Snapshot observe(const output::Schedule& schedule) const override;
  output::Findings findings(const std::vector<output::Snapshot>& snapshots) const override;
  std::optional<SlipTwice> slip_twice() const override { return slip_.compare(solver_); }
  double conservation_error() const override { return pulse::conservation_error(solver_); }
  double crossing_time() const override { return solver_.cells().crossing_time; }
  double crossing_position() const override { return solver_.cells().crossing_position; }

 private:
  Solver solver_;
  TrailingCharacteristic trailing_characteristic_;
  StoredEnergy first_energy_;
  SlipRecord slip_;                    ///< at x = 0
  std::vector<std::string> warnings_;  ///< those of the trains before
};

/// Cells with the dislocations and the momentum of many trains. `cells` are those of the same problem at t = 0.
Cells cells_of(const ManyTrains& trains, Cells cells);

/// The motion that continues from a motion that is over, in a run with this schedule. \throws NumericsError if that has
/// wrong results.
std::unique_ptr<OneTrain> one_train_after(const ManyTrains& trains, const output::Schedule& schedule);

}  // namespace slipfront::pulse
