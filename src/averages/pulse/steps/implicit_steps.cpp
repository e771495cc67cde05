#include "averages/pulse/steps/implicit_steps.hpp"

#include <algorithm>
#include <cmath>

#include "averages/pulse/steps/step_scales.hpp"
#include "math/digits.hpp"
#include "slipfront/error.hpp"

namespace slipfront::pulse {
namespace {

/// Below this fraction of the mean speed so far, friction is taken as viscous. Such motion adds at most this fraction
/// to the slip.
constexpr double creep = 1e-6;
/// With steep friction, we give up linearised steps that are shorter than this fraction of the time in which a wave
/// crosses a cell.
constexpr double far_too_short = 1e-3;

}  // namespace

ImplicitSteps::ImplicitSteps(const Problem& problem, const StepScales& measures, const Staggered& staggered)
    : problem_(problem),
      measures_(measures),
      rodas_(staggered.faces(), staggered.size(), Staggered::reach, bool(problem.forcing)),
      euler_(staggered.size()),
      unknowns_(staggered.size()),
      rate_(staggered.size()),
      next_(staggered.size()),
      scale_(2 * staggered.faces()),
      cell_scale_(2 * (staggered.faces() - 1)) {}

double ImplicitSteps::friction_rate_from_rest(const Cells& cells, Staggered& staggered) {
  faces_from_cells(cells, staggered, unknowns_);
  staggered.viscous_below(0);
  staggered.start_from(cells.s);
  staggered(cells.time, unknowns_.data(), rate_.data());
  return staggered.terminal(rate_.data()).rate;
}

/// Finds the scales at the faces from those of the cells, and the rates at the present time.
void ImplicitSteps::find_scale(const Cells& cells, Equations& equations, double crossing) {
  Semidiscrete& semidiscrete = equations.semidiscrete();
  Staggered& staggered = equations.staggered(cells);
  measures_.find_scale(cells, semidiscrete, crossing, cell_scale_);
  const ConstValues of_cells(cell_scale_.data(), cells.size());
  double fastest = 0;
  for (std::size_t i = 0; i < cells.size(); ++i)
    if (cells.charge[i] > 0) fastest = std::fmax(fastest, of_cells.momentum(i) / cells.charge[i]);
  staggered.viscous_below(creep * measures_.mean_speed(cells));
  staggered.start_from(cells.s);
  staggered(cells.time, unknowns_.data(), rate_.data());
  if (is_steep(problem_.friction) && semidiscrete.largest_friction_rate() == 0) {  // all is at rest
    const Staggered::Terminal terminal = staggered.terminal(rate_.data());
    if (terminal.velocity > 0) {
      fastest = terminal.momentum;
      staggered.viscous_below(creep * terminal.velocity);
    }
  }
  const FaceValues at(scale_.data(), staggered.faces());
  for (std::size_t face = 0; face < staggered.faces(); ++face) {
    at.width_left_of(face) = of_cells.width(face == 0 ? 0 : face - 1);
    at.momentum(face) = std::fmax(staggered.charge_around(face) * fastest, smallest_scale);
  }
}

double ImplicitSteps::take(Cells& cells, Equations& equations, double remaining, double crossing) {
  Staggered& staggered = equations.staggered(cells);
  if (cells.face_momentum.empty()) cells.step = 0;
  faces_from_cells(cells, staggered, unknowns_);
  find_scale(cells, equations, crossing);
  const double length = take_by_linearisation(cells, equations, remaining, crossing);
  return length > 0 ? length : take_by_faces(cells, staggered, std::fmin(crossing, remaining));
}

/// Returns 0 if friction is so steep that linearised steps would be far too short.
double ImplicitSteps::take_by_linearisation(Cells& cells, Equations& equations, double remaining, double crossing) {
  Staggered& staggered = equations.staggered(cells);
  const Rates f = [&staggered](double t, const double* z, double* dz) { staggered(t, z, dz); };
  const double friction_rate = equations.semidiscrete().largest_friction_rate();
  constexpr double slow = 1e-4;
  const bool steep = is_steep(problem_.friction);
  rodas_.linearise(f, cells.time, unknowns_, rate_, scale_, steep ? slow : 0);
  const double wanted = cells.step > 0 ? cells.step : std::fmin(crossing, 1 / friction_rate);
  const double shortest = steep ? far_too_short * std::fmin(crossing, remaining) : 0;
  if (wanted < shortest) return 0;
  const auto attempt = [&](double dt) -> StepAttempt {
    try {
      return rodas_(f, cells.time, dt, unknowns_, rate_, {scale_, problem_.tolerance, friction_rate}, next_);
    } catch (const NumericsError&) {  // a stage left the range of states
      return {};
    }
  };
  const StepControl control{.order = 4, .failure_factor = 0.2};
  const double first = step_within(remaining, wanted);
  StepAttempt last;
  const StepTaken step = take_step(
      control, first, [&](double dt) { return last = attempt(dt); },
      [&](double dt, int) {
        const double next = dt * control.reduction(last);
        if (next < shortest) return true;
        if (!(cells.time + next > cells.time))
          throw NumericsError("t = " + digits(cells.time) +
                              ": the time step fell below the rounding error of the time");
        staggered.start_from(cells.s);
        return false;
      });
  if (step.length == 0) return 0;
  // A step that was shortened to end on a given time is no measure of the next one.
  cells.step = step.length == first && first < wanted ? std::fmax(wanted, step.next) : step.next;
  cells_from_faces(staggered, next_, cells);
  cells.s = staggered.s();
  return step.length;
}

StepAttempt ImplicitSteps::attempt_by_faces(const Cells& cells, Staggered& staggered, double dt) {
  constexpr double of_momentum_least = 0.05;  // an error of momentum lasts for one friction time only
  const std::size_t faces = staggered.faces();
  try {
    staggered.start_from(cells.s);
    euler_([&](double t, double length, const double* z, double* to) { staggered.split_step(t, length, z, to); },
           cells.time, dt, unknowns_, next_);
  } catch (const NumericsError&) {  // a stage left the range of states
    return {};
  }
  const auto off = [&](std::size_t i) {
    return euler_.difference(i) / std::fmax(scale_[i], std::fabs(euler_.after_halves(i)));
  };
  double sum = 0;
  for (std::size_t f = 0; f < faces; ++f) {
    const double of_width = off(f), of_momentum = off(faces + f);
    sum += of_width * of_width;
    sum += of_momentum_least * of_momentum_least * of_momentum * of_momentum;
  }
  const double error = std::sqrt(sum / static_cast<double>(2 * faces)) / problem_.explicit_tolerance;
  bool compressed = false;  // whether a cell has lost nine tenths of its width
  for (std::size_t i = 1; i < faces; ++i)
    compressed = compressed || (!(next_[i] > unknowns_[i] / 10) && unknowns_[i] > 0);
  return {.succeeded = std::isfinite(error) && !compressed, .error = error};
}

double ImplicitSteps::take_by_faces(Cells& cells, Staggered& staggered, double longest) {
  staggered.viscous_below(0);
  const StepControl control{.order = 2, .failure_factor = 0.2};
  StepAttempt last;
  const StepTaken step = take_step(
      control, longest, [&](double dt) { return last = attempt_by_faces(cells, staggered, dt); },
      [&](double dt, int) {
        if (!(cells.time + dt * control.reduction(last) > cells.time)) throw too_strong_forces(cells.time);
        return false;
      });
  cells.step = step.next;
  cells_from_faces(staggered, next_, cells);
  cells.s = staggered.s();
  return step.length;
}

}  // namespace slipfront::pulse
