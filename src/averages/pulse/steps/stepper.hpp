#pragma once

#include <memory>
#include <string>
#include <vector>

#include "averages/pulse/grid/cells.hpp"
#include "averages/pulse/staggered/staggered.hpp"
#include "averages/pulse/steps/schemes.hpp"

namespace slipfront::pulse {

/// Advances the cells of a problem step by step. It chooses which of three kinds a step is (explicit, with friction
/// split off cell by cell, or implicit), and keeps the arrays that these work with.
class Stepper {
 public:
  /// The arguments outlive it.
  Stepper(const Problem& problem, const InitialGrid& initial);

  /// Sets everything up for other cells.
  void rebuild(const Cells& cells);
  Equations& equations() { return equations_; }
  const StateGrid& state_grid() const { return state_grid_; }

  /// Takes one step, which does not pass `time`.
  void step(Cells& cells, double time);
  /// Whether the last step might have been different if its `time` had been later.
  bool aimed_at_time() const { return aimed_; }

  /// About how many steps the next `duration` takes: those that waves allow, or fewer where viscous friction rules.
  double expected_steps(const Cells& cells, double duration);
  /// The reason for short steps, with the position, as a sentence without a full stop for a message.
  std::string reason_of_short_steps(const Cells& cells);

 private:
  /// Rates of the cells now, which is where a step begins.
  const std::vector<double>& rates_of(const Cells& cells);
  double friction_rate(const Cells& cells);
  bool is_stiff(const Cells& cells, double friction_rate);
  void look_for_crossing(Cells& cells);
  double take(Cells& cells, double remaining);
  ImplicitSteps& implicit_steps(const Cells& cells);
  double longest_attempt(const Cells& cells, bool stiff, double crossing) const;

  const Problem& problem_;
  const InitialGrid& initial_;
  StepScales measures_;
  Equations equations_;
  StateGrid state_grid_;
  bool by_cells_;               ///< whether friction is taken cell by cell
  double longest_attempt_ = 0;  ///< an upper limit of the length that the last step would have tried first
  bool aimed_ = false;
  std::vector<double> rate_;
  std::unique_ptr<ExplicitSteps> explicit_;
  std::unique_ptr<SplitSteps> split_;
  std::unique_ptr<ImplicitSteps> implicit_;  ///< made when friction first rules
};

}  // namespace slipfront::pulse
