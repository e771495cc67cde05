#include "pulse/steps/explicit_steps.hpp"

#include <algorithm>
#include <cmath>

#include "modulation/equations.hpp"
#include "pulse/steps/step_limits.hpp"

namespace slipfront::pulse {
namespace {

/// Dry friction cannot reverse the motion of a cell. If a step has reversed it, the cell is at rest, and moves again
/// only if the push is large enough.
///
/// A cell is also at rest if a stage of the step has turned it back and no other force is as strong as `friction` (per
/// dislocation). The momentum that the step would have given it is then no error. Neither is the effect of its friction
/// on the means over neighbouring cells.
void stop_reversals(const Ssprk54& step, double friction, const std::vector<double>& charge,
                    const std::vector<double>& before, std::vector<double>& after, std::vector<double>& scale) {
  for (std::size_t cell = 0; cell < charge.size(); ++cell) {
    const std::size_t i = charge.size() + cell;
    const bool reversed = before[i] * after[i] < 0;
    const bool held =
        (reversed || step.returns_to_zero(i, before[i])) && step.largest_rate(i) <= 2 * friction * charge[cell];
    if (!reversed && !held) continue;
    after[i] = 0;
    if (!held) continue;
    for (std::size_t j = cell > 1 ? cell - 2 : 0; j <= std::min(cell + 2, charge.size() - 1); ++j)
      scale[charge.size() + j] = HUGE_VAL;
  }
}

/// Restores the exact values of cells that the step skipped: its weighted sums of an unchanged width are rounded.
void keep_others(CellRange awake, const std::vector<double>& before, std::vector<double>& after, std::size_t cells) {
  const auto copy = [&](std::size_t begin, std::size_t end) {
    for (std::size_t first : {begin, cells + begin})
      std::copy_n(before.data() + first, end - begin, after.data() + first);
  };
  copy(0, awake.begin);
  copy(awake.end, cells);
}

}  // namespace

ExplicitSteps::ExplicitSteps(const Problem& problem, const Measures& measures, std::size_t cells)
    : problem_(problem),
      measures_(measures),
      step_(Values::size(cells)),
      before_(Values::size(cells)),
      scale_(2 * cells) {}

StepAttempt ExplicitSteps::attempt(Cells& cells, Semidiscrete& equations, const std::vector<double>& rate, double dt) {
  const Rates f = [&equations](double t, const double* y, double* dy) { equations(t, y, dy); };
  const double friction = modulation::force_per_dislocation(problem_.friction.strength_at_rest());
  step_(f, cells.time, dt, cells.unknowns, rate);
  keep_others(equations.awake(), before_, cells.unknowns, cells.size());
  if (problem_.friction.sticks()) stop_reversals(step_, friction, cells.charge, before_, cells.unknowns, scale_);
  const double error = std::fmax(step_.error(dt, rate, scale_, equations.shocked()), measures_.unseen_push(cells, dt)) /
                       problem_.explicit_tolerance;
  return {.succeeded = true, .error = error, .resolved = !cells_jump(before_, cells.unknowns, cells.charge)};
}

double ExplicitSteps::take(Cells& cells, Semidiscrete& equations, const std::vector<double>& rate, double remaining,
                           double crossing) {
  if (!cells.face_momentum.empty()) {
    cells.face_momentum.clear();
    cells.step = 0;
  }
  before_ = cells.unknowns;
  measures_.find_scale(cells, equations, crossing, scale_);
  const double wanted = cells.step > 0 ? std::fmin(crossing, cells.step) : crossing;
  const StepTaken step = take_step_from(
      before_, cells, StepControl{.order = 4}, step_within(remaining, wanted),
      [&](double dt) { return attempt(cells, equations, rate, dt); },
      [&] {
        equations.start_from(cells.s);
        measures_.find_scale(cells, equations, crossing, scale_);
      });
  cells.step = step.next;
  cells.s = equations.s();
  return step.length;
}

}  // namespace slipfront::pulse
