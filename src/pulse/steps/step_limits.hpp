#pragma once

#include <exception>
#include <vector>

#include "foundation/math/step_control.hpp"
#include "pulse/grid/cells.hpp"
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

}  // namespace slipfront::pulse
