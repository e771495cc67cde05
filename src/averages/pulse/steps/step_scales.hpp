#pragma once

#include <exception>
#include <vector>

#include "averages/pulse/grid/cells.hpp"
#include "averages/pulse/grid/layout.hpp"
#include "averages/pulse/space/semidiscrete.hpp"
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

}  // namespace slipfront::pulse
