#include "averages/pulse/steps/schemes.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "averages/pulse/grid/cells.hpp"
#include "averages/pulse/time/integrators.hpp"
#include "math/digits.hpp"
#include "slipfront/error.hpp"
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

NumericsError too_strong_forces(double time) {
  return NumericsError("t = " + digits(time) +
                       ": the time step failed: the forces on a cell exceed what any step can resolve");
}

bool cells_jump(const std::vector<double>& before, const std::vector<double>& after,
                const std::vector<double>& charge) {
  const ConstValues was(before.data(), charge.size()), is(after.data(), charge.size());
  for (std::size_t i = 0; i < charge.size(); ++i) {
    const double M = was.momentum(i);
    if (std::fabs(is.momentum(i) - M) > 4 * charge[i] + std::fabs(M) / 2) return true;
    if (charge[i] > 0 && !(is.width(i) > was.width(i) / 10)) return true;
  }
  return false;
}

using std::numbers::pi;

double StepScales::unseen_push(const Cells& cells, double dt) const {
  if (!problem_.forcing) return 0;
  constexpr double last = Ssprk54::last_stage;
  const std::size_t stride = std::max<std::size_t>(cells.size() / 64, 1);
  const double before = cells.time + (2 * last - 1) * dt, stage = cells.time + last * dt, end = cells.time + dt;
  double missed = 0, largest = 0, left = cells.left_edge();  // the face left of cell `counted`
  std::size_t counted = 0;
  for (std::size_t i = 0; i < cells.size(); i += stride) {
    if (cells.charge[i] == 0) continue;
    for (; counted < i; ++counted) left += cells.width(counted);
    const double x = left + cells.width(i) / 2;
    const double at_stage = problem_.forcing(x, stage), at_end = problem_.forcing(x, end);
    const double expected = 2 * at_stage - problem_.forcing(x, before);
    missed = std::fmax(missed, 2 * pi * (1 - last) * dt * std::fabs(at_end - expected));
    const double pushed = 2 * pi * dt * std::fmax(std::fabs(at_stage), std::fabs(at_end));
    largest = std::fmax(largest, std::fmax(pushed, std::fabs(cells.momentum(i) / cells.charge[i])));
  }
  return largest > 0 ? missed / largest : 0;
}

double StepScales::mean_speed(const Cells& cells) const {
  if (cells.time == 0) return 0;
  const std::size_t stride = std::max<std::size_t>(cells.size() / 64, 1);
  double x = cells.left_edge(), charge = -cells.entered_left, way = 0;
  for (std::size_t f = 0; f < cells.size(); ++f) {
    if (f % stride == 0) way = std::fmax(way, std::fabs(x - initial_.position_of(charge)));
    x += cells.width(f);
    charge += cells.charge[f];
  }
  return way / cells.time;
}

/// Momenta are measured by the largest, or at rest by what the pressure soon makes of the densest cell: a sparse cell
/// is pushed by its neighbours. What is slower by a thousandth than the mean so far, as after a push that has ended,
/// adds nothing to slip; and the forces of a contact profile are differences of numbers of size 1.
void StepScales::find_scale(const Cells& cells, const Semidiscrete& equations, double crossing,
                            std::vector<double>& scale) const {
  const double rate = equations.largest_friction_rate();
  const double damping = rate > 0 ? rate * crossing : 0;  // waves may never cross a cell: 0 times infinity
  double fastest = 8e-3 * *std::max_element(equations.s().begin(), equations.s().end()) / (1 + damping);
  constexpr double slow = 8e-3, rounding = 1e-8;
  if (!cells.face_momentum.empty() || takes_friction_by_cells(problem_))
    fastest = std::fmax(fastest, slow * mean_speed(cells));
  if (initial_.contact_varies) fastest = std::fmax(fastest, rounding / (1 + rate));
  for (std::size_t i = 0; i < cells.size(); ++i)
    if (cells.charge[i] > 0) fastest = std::fmax(fastest, std::fabs(cells.momentum(i) / cells.charge[i]));
  for (std::size_t i = 0; i < cells.size(); ++i) {
    scale[i] = cells.width(i);
    scale[cells.size() + i] = cells.charge[i] > 0 ? std::fmax(cells.charge[i] * fastest, smallest_scale) : 1;
  }
}

}  // namespace slipfront::pulse
