#include "pulse/steps/split_steps.hpp"

#include <algorithm>
#include <cmath>

#include "pulse/steps/step_limits.hpp"

namespace slipfront::pulse {

SplitSteps::SplitSteps(const Problem& problem, const Measures& measures, const StateGrid& grid, std::size_t cells)
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
