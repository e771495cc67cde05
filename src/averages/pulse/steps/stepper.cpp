// How many steps a run should take, and what makes steps short.

#include "averages/pulse/steps/stepper.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "averages/pulse/grid/layout.hpp"
#include "averages/pulse/time/integrators.hpp"
#include "math/digits.hpp"

namespace slipfront::pulse {
namespace {

/// Friction times in which a wave crosses a cell of average width, above which steps are implicit: there the pulse
/// diffuses.
constexpr double stiff_above = 1;
/// And below which they are explicit again.
constexpr double stiff_below = 0.3;
/// Explicit steps are stable up to 4 friction times or so.
constexpr double longest_in_friction_times = 2;

}  // namespace

Stepper::Stepper(const Problem& problem, const InitialGrid& initial)
    : problem_(problem),
      initial_(initial),
      measures_(problem, initial),
      equations_(problem, initial.free),
      state_grid_(problem.friction, problem.left, problem.right, static_cast<std::size_t>(problem.cells)),
      by_cells_(takes_friction_by_cells(problem)) {}

void Stepper::rebuild(const Cells& cells) {
  equations_.rebuild(cells);
  rate_.assign(cells.unknowns.size(), 0.0);
  explicit_.reset();
  split_.reset();
  implicit_.reset();
  if (by_cells_)
    split_ = std::make_unique<SplitSteps>(problem_, measures_, state_grid_, cells.size());
  else
    explicit_ = std::make_unique<ExplicitSteps>(problem_, measures_, cells.size());
}

ImplicitSteps& Stepper::implicit_steps(const Cells& cells) {
  if (!implicit_) implicit_ = std::make_unique<ImplicitSteps>(problem_, measures_, equations_.staggered(cells));
  return *implicit_;
}

/// The equations start as in a resumed run, whoever has looked at them since the last step.
const std::vector<double>& Stepper::rates_of(const Cells& cells) {
  Semidiscrete& equations = equations_.semidiscrete();
  equations.wake();
  equations.start_from(cells.s);
  equations(cells.time, cells.unknowns.data(), rate_.data());
  return rate_;
}

/// Rate at which friction takes the momentum of the dislocations that count: those that are fastest, or where all but
/// rest those on which most force acts, at the velocity that friction allows them. By the closure of the paper friction
/// hardly slows a dilute train, and the fastest dislocations are a few at a free edge: there it is the mean of all.
double Stepper::friction_rate(const Cells& cells) {
  Semidiscrete& equations = equations_.semidiscrete();
  if (!by_cells_) return equations.largest_friction_rate();
  if (problem_.friction.state_size() > 0) return 0;  // no other steps know the state
  const bool consistent = problem_.friction.closure() == friction::Closure::consistent;
  const double rate = consistent ? equations.friction_rate_of_fastest() : equations.mean_friction_rate();
  return rate > 0 ? rate : implicit_steps(cells).friction_rate_from_rest(cells, equations_.staggered(cells));
}

bool Stepper::is_stiff(const Cells& cells, double rate) {
  if (problem_.periodic) return false;
  Semidiscrete& equations = equations_.semidiscrete();
  const bool at_rest = equations.largest_friction_rate() == 0;
  if (!by_cells_ && is_steep(problem_.friction) && at_rest) return true;
  const double friction_times = rate * equations.mean_crossing_time(cells.unknowns.data());
  return friction_times > (cells.face_momentum.empty() ? stiff_above : stiff_below);
}

void Stepper::look_for_crossing(Cells& cells) {
  const std::size_t cell = equations_.semidiscrete().crossing(cells.time, cells.unknowns.data());
  if (cell >= cells.size()) return;
  cells.crossing_time = cells.time;
  cells.crossing_position = cells.centre(cell);
}

/// An upper limit of the length that a step tries first, if no time is near on which it has to end.
double Stepper::longest_attempt(const Cells& cells, bool stiff, double crossing) const {
  const bool same_kind = stiff != cells.face_momentum.empty();
  if (stiff) return same_kind ? std::fmax(cells.step, crossing) : crossing;
  const double longest = by_cells_ ? Ars443::longest_in_crossing_times * crossing : crossing;
  return same_kind && cells.step > 0 ? std::fmin(longest, cells.step) : longest;
}

double Stepper::take(Cells& cells, double remaining) {
  Semidiscrete& equations = equations_.semidiscrete();
  const double* unknowns = cells.unknowns.data();
  double crossing = problem_.cfl * equations.crossing_time(unknowns, rate_.data());
  const bool stiff = is_stiff(cells, friction_rate(cells));
  if (!stiff && !by_cells_)
    crossing = std::fmin(crossing, longest_in_friction_times / equations.largest_friction_rate());
  longest_attempt_ = longest_attempt(cells, stiff, crossing);
  if (stiff && by_cells_) equations.find_friction_rates();
  equations.let_rest(unknowns, rate_.data());
  if (stiff) return implicit_steps(cells).take(cells, equations_, remaining, crossing);
  if (by_cells_) return split_->take(cells, equations, rate_, remaining, crossing);
  return explicit_->take(cells, equations, rate_, remaining, crossing);
}

void Stepper::step(Cells& cells, double time) {
  rates_of(cells);
  if (std::isnan(cells.crossing_time)) look_for_crossing(cells);
  const double to_time = time - cells.time;
  const double limit = std::fmin(problem_.longest_step, gaps_close_in(problem_, cells, rate_.data()));
  const double dt = take(cells, std::fmin(to_time, limit));
  // The two last steps to `time` have equal lengths (step_within). The margin is for a rounding of `time`.
  constexpr double margin = 1e-9;
  const double at_least = to_time * (1 - margin);
  aimed_ = dt >= at_least || !(limit < at_least || 2 * longest_attempt_ < at_least);
  equations_.semidiscrete().wake();
  cells.time = dt == time - cells.time ? time : cells.time + dt;
  ++cells.steps;
  const bool closed = close_gaps(cells);
  if (adjust_ends(problem_, initial_.free, cells) || closed) rebuild(cells);
}

namespace {

/// Implicit steps follow the growth of what diffuses: some hundred for a decade of time, and a few for each cell.
constexpr double most_implicit_steps = 1000, implicit_steps_per_cell = 10;
/// An explicit step is not longer than so many friction times.
constexpr double friction_times_per_step = 2;
/// Crossing times of friction above which it rules whatever the waves become.
constexpr double surely_stiff = 10;

/// More steps than anyone waits for. If waves at the speed of light required as many, we estimate the speed.
constexpr double too_many_steps = 1e8;

/// Time in which a wave crosses a cell, if dislocations move at the speed `pushed`, or waves at their speed at rest if
/// they are faster. A quarter of the cells is narrower: those at a free edge are far narrower at first, but soon widen.
double typical_crossing_time(const ConstValues& values, const std::vector<double>& charge, const CellStates& trains,
                             double pushed) {
  std::vector<double> times;
  for (std::size_t i = 0; i < charge.size(); ++i)
    if (const double speed = std::fmax(pushed, trains.sound_speed[i]); charge[i] > 0 && speed > 0)
      times.push_back(values.width(i) / speed);
  if (times.empty()) return HUGE_VAL;
  const auto quarter = times.begin() + static_cast<std::ptrdiff_t>(times.size() / 4);
  std::nth_element(times.begin(), quarter, times.end());
  return *quarter;
}

/// The speed that the forcing can give a dislocation in a time, at most, as far as samples show: the momentum
/// 8 sinh(phi) grows by 2 pi F.
double pushed_speed(const Problem& problem, const Cells& cells, double duration) {
  constexpr int samples = 32;
  double largest = 0;
  for (int i = 0; i < samples; ++i) {
    const double x = cells.centre(static_cast<std::size_t>(i) * cells.size() / samples);
    for (int j = 0; j <= samples; ++j)
      largest = std::fmax(largest, std::fabs(problem.forcing(x, cells.time + duration * j / samples)));
  }
  return std::tanh(std::asinh(2 * std::numbers::pi * largest * duration / 8));
}

}  // namespace

double Stepper::expected_steps(const Cells& cells, double duration) {
  Semidiscrete& equations = equations_.semidiscrete();
  rates_of(cells);
  const double* unknowns = cells.unknowns.data();
  // A contact profile or a forcing may accelerate trains in which waves at rest are slow.
  const auto crossing_at = [&](double speed) {
    return typical_crossing_time(cells.values(), cells.charge, equations.trains(), speed);
  };
  double crossing = crossing_at(initial_.contact_varies || problem_.forcing ? 1 : 0);
  if (!initial_.contact_varies && problem_.forcing && duration > too_many_steps * crossing)
    crossing = crossing_at(pushed_speed(problem_, cells, duration));
  double shortest = std::fmin(problem_.cfl * crossing, problem_.longest_step);
  const double C = problem_.friction.linear_coefficient().value_or(0);
  if (problem_.periodic && C > 0) shortest = std::fmin(shortest, friction_times_per_step / C);
  const double by_waves = duration / shortest;
  const bool stiff = !problem_.periodic && C * equations.mean_crossing_time(unknowns) > surely_stiff;
  if (!stiff) return by_waves;
  const double by_diffusion = most_implicit_steps + implicit_steps_per_cell * static_cast<double>(cells.size());
  return std::fmin(by_waves, by_diffusion + duration / problem_.longest_step);
}

std::string Stepper::reason_of_short_steps(const Cells& cells) {
  Semidiscrete& equations = equations_.semidiscrete();
  const std::vector<double>& rates = rates_of(cells);
  const ConstValues rate(rates.data(), cells.size());
  const double* unknowns = cells.unknowns.data();
  const double crossing = problem_.cfl * equations.crossing_time(unknowns, rates.data());
  std::size_t narrowest = 0, pushed = 0;
  double most = 0;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    if (cells.charge[i] == 0) continue;
    if (cells.charge[narrowest] == 0 || cells.width(i) < cells.width(narrowest)) narrowest = i;
    const double force = std::fabs(rate.momentum(i)) / cells.charge[i];
    if (!(force > most)) continue;
    most = force;
    pushed = i;
  }
  const auto at = [&](std::size_t i) {
    return "cell " + std::to_string(i) + " of " + std::to_string(cells.size()) + ", at x = " + digits(cells.centre(i));
  };
  if (cells.step >= crossing / 4)
    return "Each step is the time in which a wave crosses the narrowest cell: " + at(narrowest) + ", " +
           digits(cells.width(narrowest), 3) + " wide";
  return "The error of a step allows steps of " + digits(cells.step, 3) + " only, although waves would allow " +
         digits(crossing, 3) + "; the largest force is on " + at(pushed);
}

}  // namespace slipfront::pulse
