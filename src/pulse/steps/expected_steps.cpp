// How many steps a run should take, and what makes steps short.

#include <algorithm>
#include <cmath>
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

/// Time in which a wave crosses a cell, of the state at rest; or, for `at_c`, something as fast as any wave can be. A
/// quarter of the cells is narrower: those at a free edge are far narrower at first, but soon widen.
double typical_crossing_time(const ConstValues& values, const std::vector<double>& charge, const CellStates& trains,
                             bool at_c) {
  std::vector<double> times;
  for (std::size_t i = 0; i < charge.size(); ++i)
    if (charge[i] > 0 && trains.sound_speed[i] > 0)
      times.push_back(values.width(i) / (at_c ? 1 : trains.sound_speed[i]));
  if (times.empty()) return HUGE_VAL;
  const auto quarter = times.begin() + static_cast<std::ptrdiff_t>(times.size() / 4);
  std::nth_element(times.begin(), quarter, times.end());
  return *quarter;
}

}  // namespace

double Stepper::expected_steps(const Cells& cells, double duration) {
  Semidiscrete& equations = equations_.semidiscrete();
  rates_of(cells);
  const double* unknowns = cells.unknowns.data();
  // A contact profile or a forcing may accelerate trains in which waves at rest are slow.
  const bool pushed = initial_.contact_varies || problem_.forcing;
  const double crossing = typical_crossing_time(cells.values(), cells.charge, equations.trains(), pushed);
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
