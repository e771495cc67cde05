#pragma once
/// \file
/// One pulse run: a problem, its output times, and the snapshots so far. A run can be saved after any step. The resumed
/// run gives bitwise identical results.

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "slipfront/averages/pulse/problem.hpp"
#include "slipfront/text/output/quantities.hpp"
#include "slipfront/text/output/run.hpp"
#include "slipfront/text/output/snapshot.hpp"

namespace slipfront::pulse {

class Solver;
struct SlipTwice;

class Run : public output::Run {
 public:
  Run(Problem problem, output::Schedule schedule);
  /// Resumes a saved run. The schedule may end later than that of the saved run. It must agree with it before the end
  /// of the saved run, and `snapshots` are then those before that end. The results are those of a run that had the
  /// later end from its start. \throws InputError if the run was saved for another problem or schedule.
  Run(Problem problem, output::Schedule schedule, std::string_view saved, std::vector<output::Snapshot> snapshots);
  ~Run() override;
  Run(Run&&) noexcept;
  Run& operator=(Run&&) noexcept;

  /// It calls `interrupted` after every step. \throws NumericsError if the solver fails, if the step budget is
  /// exhausted, or if results violate an invariant by more than 1 %.
  bool go(const std::function<bool()>& interrupted = {}) override;

  const Problem& problem() const;
  double time() const override;
  long steps() const override;
  /// Time and x at which dislocations first overtake each other, if that makes the results approximate; else NaN.
  double crossing_time() const;
  double crossing_position() const;
  /// Relative error of the number of dislocations.
  double conservation_error() const;
  /// The solver of a problem with one train at each position. \throws std::logic_error for many_trains.
  const Solver& solver() const;
  const output::Schedule& schedule() const;
  const std::vector<output::Snapshot>& snapshots() const;
  double expected_steps() const override;
  /// Wall time of the steps in seconds, without the time for the initial cells and for outputs.
  double stepping_seconds() const;
  bool finished() const override;
  std::vector<std::string> warnings() const override;
  /// Slip at x = 0, computed in two ways that should agree (pulse/checks/slip_record.hpp). Empty if x = 0 is outside
  /// the domain, or if the run has too few samples.
  std::optional<SlipTwice> slip_twice() const;
  void archive(Archive& a) override;

 private:
  struct Impl;
  std::unique_ptr<Impl> parts_;
};

/// A run that has reached its end.
struct Report {
  const Run& run;
  output::Spent spent;
};
/// The numbers of a run that its snapshots do not have.
std::span<const output::Quantity<Report>> quantities();

}  // namespace slipfront::pulse
