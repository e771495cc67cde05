// How many steps a run should take, and what makes steps short.

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "foundation/text/digits.hpp"
#include "pulse/steps/stepper.hpp"

namespace slipfront::pulse {
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
