#pragma once

#include <exception>
#include <vector>

#include "averages/pulse/friction/cell_friction.hpp"
#include "averages/pulse/grid/cells.hpp"
#include "averages/pulse/grid/layout.hpp"
#include "averages/pulse/space/semidiscrete.hpp"
#include "averages/pulse/staggered/staggered.hpp"
#include "averages/pulse/time/integrators.hpp"
#include "math/time_steps.hpp"
#include "slipfront/averages/pulse/problem.hpp"
#include "slipfront/error.hpp"

namespace slipfront::pulse {

/// Error of a run in which no step is short enough for the forces.
NumericsError too_strong_forces(double time);

/// Whether a step has changed the rapidity of some cell by about a half or more, or has compressed a cell to a tenth: a
/// dense train that runs into a sparse one, or a contact as steep as a wall. The error of the step does not show this,
/// as it leaves out the cells near a shock.
bool cells_jump(const std::vector<double>& before, const std::vector<double>& after, const std::vector<double>& charge);

/// Takes a step of the cells from the unknowns `before`. An attempt in which a stage leaves the range of states has
/// failed. After each rejected attempt the cells have their unknowns back, and restart() prepares the next one.
/// \throws NumericsError, that of the last attempt if it had one, where no step is short enough.
template <class Attempt, class Restart>
StepTaken take_step_from(const std::vector<double>& before, Cells& cells, const StepControl& control, double length,
                         const Attempt& attempt, const Restart& restart) {
  constexpr int most_shortenings = 80;
  std::exception_ptr failure;
  const auto guarded = [&](double dt) -> StepAttempt {
    failure = nullptr;
    try {
      return attempt(dt);
    } catch (const NumericsError&) {
      failure = std::current_exception();
      return {};
    }
  };
  return take_step(control, length, guarded, [&](double, int attempts) {
    cells.unknowns = before;
    if (attempts > most_shortenings && failure) std::rethrow_exception(failure);
    if (attempts > most_shortenings) throw too_strong_forces(cells.time);
    restart();
    return false;
  });
}

/// No momentum is measured by less: a scale of 0 would make the error of a cell at rest no number.
constexpr double smallest_scale = 1e-305;

/// The sizes by which the errors of time steps are measured.
class StepScales {
 public:
  StepScales(const Problem& problem, const InitialGrid& initial) : problem_(problem), initial_(initial) {}

  /// Scales of widths and momenta, in the order of the unknowns, from the last rates of `equations`.
  void find_scale(const Cells& cells, const Semidiscrete& equations, double crossing, std::vector<double>& scale) const;
  /// Largest mean velocity of some dislocations since t = 0.
  double mean_speed(const Cells& cells) const;
  /// Momentum that a step misses where the load F(x, t) jumps after the last stage of the step, as a fraction of the
  /// largest momentum that the load supplies or that there is. 64 cells are sampled, because F is costly to evaluate.
  double unseen_push(const Cells& cells, double dt) const;

 private:
  const Problem& problem_;
  const InitialGrid& initial_;
};

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

/// Steps of the staggered equations where friction rules, in which waves cross many cells.
class ImplicitSteps {
 public:
  ImplicitSteps(const Problem& problem, const StepScales& measures, const Staggered& staggered);
  /// Takes one step of at most `remaining` and returns its length. `crossing` is the time in which a wave crosses a
  /// cell. \throws NumericsError where no step is short enough.
  double take(Cells& cells, Equations& equations, double remaining, double crossing);
  /// Rate at which friction takes the momentum that it allows where all is at rest, from the largest force.
  double friction_rate_from_rest(const Cells& cells, Staggered& staggered);

 private:
  void find_scale(const Cells& cells, Equations& equations, double crossing);
  double take_by_linearisation(Cells& cells, Equations& equations, double remaining, double crossing);
  /// Serves friction so steep at rest that its slope does not show its force at the end of a step.
  double take_by_faces(Cells& cells, Staggered& staggered, double longest);
  StepAttempt attempt_by_faces(const Cells& cells, Staggered& staggered, double dt);

  const Problem& problem_;
  const StepScales& measures_;
  Rodas4 rodas_;
  ExtrapolatedEuler euler_;
  std::vector<double> unknowns_, rate_, next_, scale_, cell_scale_;
};

}  // namespace slipfront::pulse
