#pragma once

#include <vector>

#include "averages/pulse/friction/cell_friction.hpp"
#include "averages/pulse/space/semidiscrete.hpp"
#include "averages/pulse/steps/step_scales.hpp"
#include "averages/pulse/time/integrators.hpp"
#include "math/time_steps.hpp"

namespace slipfront::pulse {

/// Explicit steps, as long as waves and friction allow.
class ExplicitSteps {
 public:
  ExplicitSteps(const Problem& problem, const StepScales& measures, std::size_t cells);
  /// Takes one step of at most `remaining` and returns its length. `rate` are the rates at the present time, `crossing`
  /// is the time in which a wave crosses a cell. \throws NumericsError if no step is short enough.
  double take(Cells& cells, Semidiscrete& equations, const std::vector<double>& rate, double remaining,
              double crossing);

 private:
  StepAttempt attempt(Cells& cells, Semidiscrete& equations, const std::vector<double>& rate, double dt);

  const Problem& problem_;
  const StepScales& measures_;
  Ssprk54 step_;
  std::vector<double> before_, scale_;
};

/// Steps that treat friction cell by cell, for laws with state variables or steep at rest. The state variables and the
/// motion of the cells each advance with the values that the other has in the middle of the step.
class SplitSteps {
 public:
  SplitSteps(const Problem& problem, const StepScales& measures, const StateGrid& grid, std::size_t cells);
  /// Takes one step of at most `remaining` and returns its length. `rate` are the rates at the present time, without
  /// friction; `crossing` is the time in which a wave crosses a cell. \throws NumericsError if no step is short enough.
  double take(Cells& cells, Semidiscrete& equations, const std::vector<double>& rate, double remaining,
              double crossing);

 private:
  StepAttempt attempt(Cells& cells, Semidiscrete& equations, const std::vector<double>& rate, double dt);
  double advance_state(const Cells& cells, double dt);
  void mix(double share);

  const Problem& problem_;
  const StepScales& measures_;
  const StateGrid& grid_;
  bool has_state_;
  Ars443 step_;
  CellFriction friction_;
  std::vector<double> before_, scale_, forces_, x_;
  std::vector<double> half_, better_,
      after_;  ///< state in the middle of the step, by its start and by both ends; at its end
  StateGrid::Passing at_cells_, at_start_, at_end_, mixed_;
};

}  // namespace slipfront::pulse
