#include "averages/pulse/steps/explicit_steps.hpp"

#include <algorithm>
#include <cmath>

#include "averages/pulse/steps/step_scales.hpp"
#include "theory/modulation/equations.hpp"

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

ExplicitSteps::ExplicitSteps(const Problem& problem, const StepScales& measures, std::size_t cells)
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

SplitSteps::SplitSteps(const Problem& problem, const StepScales& measures, const StateGrid& grid, std::size_t cells)
    : problem_(problem),
      measures_(measures),
      grid_(grid),
      has_state_(problem.friction.state_size() > 0),
      step_(cells, Values::size(cells)),
      friction_(problem, cells),
      before_(Values::size(cells)),
      scale_(2 * cells),
      forces_(cells),
      x_(cells) {}

/// Slip velocities `share` of the way from the start of the step to its end.
void SplitSteps::mix(double share) {
  mixed_ = at_start_;
  for (std::size_t i = 0; i < mixed_.mean.size(); ++i) {
    mixed_.mean[i] += share * (at_end_.mean[i] - at_start_.mean[i]);
    mixed_.typical[i] += share * (at_end_.typical[i] - at_start_.typical[i]);
  }
}

/// Advances the state with the velocities at both ends of the step. Returns the error of the step that comes from the
/// state in its middle, which was found from the velocities at the start.
double SplitSteps::advance_state(const Cells& cells, double dt) {
  cells.find_centres(x_);
  friction_.find_passing(cells, at_cells_);
  grid_.find_passing(x_, at_cells_, at_end_);
  forces_ = friction_.forces();
  better_ = cells.state;
  mix(0.25);
  grid_.advance(mixed_, dt / 2, better_);
  after_ = cells.state;
  mix(0.5);
  grid_.advance(mixed_, dt, after_);
  friction_.take_state(grid_, better_, dt);
  return friction_.state_error(forces_, dt, scale_);
}

StepAttempt SplitSteps::attempt(Cells& cells, Semidiscrete& equations, const std::vector<double>& rate, double dt) {
  const Rates f = [&equations](double t, const double* y, double* dy) { equations(t, y, dy); };
  const auto friction = [this](const double* y, const double* free, double time, double* momentum, double* velocity) {
    friction_(y, free, time, momentum, velocity);
  };
  half_ = cells.state;
  if (has_state_) grid_.advance(at_start_, dt / 2, half_);
  friction_.take_state(grid_, half_, dt);
  step_(f, friction, cells.time, dt, cells.unknowns, rate);
  const std::vector<double>& friction_times = friction_.friction_times(dt);
  const double of_state = has_state_ ? advance_state(cells, dt) : 0;
  const double error = std::max({step_.error(cells.unknowns, scale_, equations.shocked(), friction_times), of_state,
                                 measures_.unseen_push(cells, dt)}) /
                       problem_.explicit_tolerance;
  return {.succeeded = true, .error = error, .resolved = !cells_jump(before_, cells.unknowns, cells.charge)};
}

double SplitSteps::take(Cells& cells, Semidiscrete& equations, const std::vector<double>& rate, double remaining,
                        double crossing) {
  if (!cells.face_momentum.empty()) {
    cells.face_momentum.clear();
    cells.step = 0;
  }
  before_ = cells.unknowns;
  friction_.start(cells, equations.trains(), equations.awake(), grid_);
  if (has_state_) {
    friction_.find_passing(cells, at_cells_);
    grid_.find_passing(friction_.x(), at_cells_, at_start_);
  }
  measures_.find_scale(cells, equations, crossing, scale_);
  const double longest = Ars443::longest_in_crossing_times * crossing;
  const double wanted = cells.step > 0 ? std::fmin(longest, cells.step) : longest;
  const StepTaken step = take_step_from(
      before_, cells, StepControl{.order = 3}, step_within(remaining, wanted),
      [&](double dt) { return attempt(cells, equations, rate, dt); },
      [&] {
        equations.start_from(cells.s);
        friction_.restart();
      });
  cells.step = step.next;
  if (has_state_) cells.state = after_;
  cells.s = equations.s();
  return step.length;
}

}  // namespace slipfront::pulse
