// Which step the solver takes, explicit or linearly implicit, and how long it is.

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <vector>

#include "foundation/math/step_control.hpp"
#include "foundation/text/digits.hpp"
#include "modulation/equations.hpp"
#include "pulse/space/semidiscrete.hpp"
#include "pulse/space/staggered.hpp"
#include "pulse/time/cell_friction.hpp"
#include "pulse/time/rodas4.hpp"
#include "pulse/time/ssprk54.hpp"
#include "pulse/time/step_limits.hpp"
#include "slipfront/error.hpp"
#include "slipfront/pulse/solver.hpp"

namespace slipfront::pulse {
namespace {

using std::numbers::pi;

/// Friction times in which a wave crosses a cell of average width, above which steps are implicit: there the pulse
/// diffuses.
constexpr double stiff_above = 1;
/// Explicit steps are stable up to 4 or so.
constexpr double longest_in_friction_times = 2;
/// And below which they are explicit again.
constexpr double stiff_below = 0.3;

/// No momentum is measured by less: a scale of 0 would make the error of what rests no number.
constexpr double smallest_scale = 1e-305;

/// Dry friction cannot reverse a cell: one that would have is at rest, and moves on only if pushed hard enough. So is
/// one that `friction` (that of a dislocation) holds, as it has turned it back in a stage of the step and nothing else
/// acts as strongly: what the step would have made of its momentum is no error then, nor what its friction does in the
/// means over the cells beside it.
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

/// Cells that were left alone in a step keep their bits: its sums of a width with itself are rounded.
void keep_others(Stretch awake, const std::vector<double>& before, std::vector<double>& after, std::size_t cells) {
  const auto copy = [&](std::size_t begin, std::size_t end) {
    for (std::size_t first : {begin, cells + begin})
      std::copy_n(before.data() + first, end - begin, after.data() + first);
  };
  copy(0, awake.begin);
  copy(awake.end, cells);
}

}  // namespace

bool Solver::advance_to(double time, const std::function<bool()>& interrupted) {
  while (cells_.time < time)
    if (!advance_until_gap_closes(time, interrupted)) break;
  return cells_.time >= time;
}

/// What steps work with, as long as the cells stay the same.
struct Solver::Work {
  Rates f;
  Ssprk54 explicit_step;
  std::vector<double> rate, next, scale;
  std::unique_ptr<Rodas4> implicit_step;    // made when friction first rules
  std::unique_ptr<MemoryStep> memory_step;  // if friction remembers

  explicit Work(Semidiscrete& equations, std::size_t cells, std::size_t size)
      : f([&equations](double t, const double* y, double* dy) { equations(t, y, dy); }),
        explicit_step(size),
        rate(size),
        next(size),
        scale(2 * cells) {}
};

double Solver::step_explicitly(Work& work, double remaining, double crossing) {
  if (!cells_.face_momentum.empty()) {
    cells_.face_momentum.clear();
    cells_.step = 0;
  }
  const double wanted = cells_.step > 0 ? std::fmin(crossing, cells_.step) : crossing;
  double dt = step_within(remaining, wanted);
  const bool dry = problem_.friction.sticks();
  const double friction = modulation::force_per_dislocation(problem_.friction.strength_at_rest());
  work.next = cells_.unknowns;
  // What comes up within a step may be too hard for it: shorter, then.
  for (int tries = 0;; ++tries) {
    double factor = 0.5;
    try {
      find_scale(crossing, work.scale);
      work.explicit_step(work.f, cells_.time, dt, cells_.unknowns, work.rate);
      keep_others(equations_->awake(), work.next, cells_.unknowns, size());
      if (dry) stop_reversals(work.explicit_step, friction, cells_.charge, work.next, cells_.unknowns, work.scale);
      const double error =
          std::fmax(work.explicit_step.error(dt, work.rate, work.scale, equations_->shocked()), unseen_push(dt)) /
          problem_.explicit_tolerance;
      const bool jumped = cells_jump(work.next, cells_.unknowns, cells_.charge);
      factor = std::clamp(0.9 * std::pow(error, -0.25), 0.2, 4.0);
      if (error <= 1 && !jumped) {
        cells_.step = dt * factor;
        break;
      }
      if (jumped) factor = std::fmin(factor, 0.5);
      if (tries == 80) throw too_strong_forces(cells_.time);
    } catch (const NumericsError&) {
      if (tries == 80) throw;
    }
    cells_.unknowns = work.next;
    equations_->start_from(cells_.s);
    dt *= factor;
  }
  cells_.s = equations_->s();
  return dt;
}

/// A forcing that jumps after the last stage of a step is seen by none of them. Returns the momentum that the step has
/// missed, in units of the largest that the forcing gives or there is; of a few cells.
double Solver::unseen_push(double dt) const {
  if (!problem_.forcing) return 0;
  constexpr double last = Ssprk54::last_stage;
  const std::size_t stride = std::max<std::size_t>(size() / 64, 1);
  const double before = cells_.time + (2 * last - 1) * dt, stage = cells_.time + last * dt, end = cells_.time + dt;
  double missed = 0, largest = 0, left = cells_.left_edge();  // the face left of cell `counted`
  std::size_t counted = 0;
  for (std::size_t i = 0; i < size(); i += stride) {
    if (cells_.charge[i] == 0) continue;
    for (; counted < i; ++counted) left += cells_.width(counted);
    const double x = left + cells_.width(i) / 2;
    const double at_stage = problem_.forcing(x, stage), at_end = problem_.forcing(x, end);
    const double expected = 2 * at_stage - problem_.forcing(x, before);
    missed = std::fmax(missed, 2 * pi * (1 - last) * dt * std::fabs(at_end - expected));
    const double pushed = 2 * pi * dt * std::fmax(std::fabs(at_stage), std::fabs(at_end));
    largest = std::fmax(largest, std::fmax(pushed, std::fabs(cells_.momentum(i) / cells_.charge[i])));
  }
  return largest > 0 ? missed / largest : 0;
}

/// How far the dislocations have come on average in a unit of time, at most; of some of them.
double Solver::mean_speed() const {
  if (cells_.time == 0) return 0;
  const std::size_t stride = std::max<std::size_t>(size() / 64, 1);
  double x = cells_.left_edge(), charge = -cells_.entered_left, way = 0;
  for (std::size_t f = 0; f < size(); ++f) {
    if (f % stride == 0) way = std::fmax(way, std::fabs(x - first_place(charge)));
    x += cells_.width(f);
    charge += cells_.charge[f];
  }
  return way / cells_.time;
}

/// Momenta are measured by the largest, or at rest by what the pressure soon makes of the densest cell: a sparse cell
/// is pushed by its neighbours. What is slower by a thousandth than the mean so far, as after a push that has ended,
/// adds nothing to slip; and the forces of a contact profile are differences of numbers of size 1.
void Solver::find_scale(double crossing, std::vector<double>& scale) const {
  const double rate = equations_->largest_friction_rate();
  const double damping = rate > 0 ? rate * crossing : 0;  // waves may never cross a cell: 0 times infinity
  double fastest = 8e-3 * *std::max_element(equations_->s().begin(), equations_->s().end()) / (1 + damping);
  constexpr double slow = 8e-3, rounding = 1e-8;
  if (!cells_.face_momentum.empty()) fastest = std::fmax(fastest, slow * mean_speed());
  if (contact_varies_) fastest = std::fmax(fastest, rounding / (1 + rate));
  for (std::size_t i = 0; i < size(); ++i)
    if (cells_.charge[i] > 0) fastest = std::fmax(fastest, std::fabs(cells_.momentum(i) / cells_.charge[i]));
  for (std::size_t i = 0; i < size(); ++i) {
    scale[i] = cells_.width(i);
    scale[size() + i] = cells_.charge[i] > 0 ? std::fmax(cells_.charge[i] * fastest, smallest_scale) : 1;
  }
}

/// Whether friction damps what hardly moves at any rate, but does not hold it.
bool Solver::steep() const {
  const friction::Friction& f = problem_.friction;
  return f.acts() && f.steep_at_rest() && !f.sticks();
}

/// Whether steps take friction cell by cell: where it remembers, or is steep at rest.
bool Solver::steps_by_parts() const {
  const friction::Friction& f = problem_.friction;
  return f.state_size() > 0 || (steep() && !problem_.periodic);
}

/// Of the dislocations that count, at which friction takes their momentum: those that are fastest, or all but at rest
/// those on which most force acts, at the velocity that friction allows them. By the closure of the paper friction
/// hardly slows a dilute train, and the fastest dislocations are a few at a free edge: there it is the mean of all.
double Solver::friction_rate_by_parts() const {
  if (problem_.friction.state_size() > 0) return 0;  // steps by parts are all there are
  const bool consistent = problem_.friction.closure() == friction::Closure::consistent;
  const double rate = consistent ? equations_->friction_rate_of_fastest() : equations_->mean_friction_rate();
  if (rate > 0) return rate;
  Staggered& staggered = this->staggered();
  const std::vector<double> z = faces_of_cells(staggered);
  std::vector<double> rates(z.size());
  staggered.viscous_below(0);
  staggered.start_from(cells_.s);
  staggered(cells_.time, z.data(), rates.data());
  return staggered.terminal(rates.data()).rate;
}

/// And all is at rest, from the last rates.
bool Solver::steep_from_rest() const { return steep() && equations_->largest_friction_rate() == 0; }

std::vector<double> Solver::faces_of_cells(const Staggered& staggered) const {
  const std::size_t n = size();
  std::vector<double> unknowns(staggered.size()), momenta = cells_.face_momentum;
  if (momenta.empty()) {
    std::vector<double> in_cells(n);
    for (std::size_t i = 0; i < n; ++i) in_cells[i] = cells_.momentum(i);
    momenta = staggered.face_momenta(in_cells);
  }
  const FaceValues faces(unknowns.data(), n + 1);
  faces.left_edge() = cells_.left_edge();
  for (std::size_t i = 0; i < n; ++i) faces.width(i) = cells_.width(i);
  for (std::size_t f = 0; f <= n; ++f) faces.momentum(f) = momenta[f];
  const ConstValues cells = cells_.values();
  faces.dissipated() = cells.dissipated();
  faces.supplied() = cells.supplied();
  faces.through_ends() = cells.through_ends();
  return unknowns;
}

void Solver::cells_of_faces(const Staggered& staggered, const std::vector<double>& unknowns) {
  const std::size_t n = size();
  const ConstFaceValues faces(unknowns.data(), n + 1);
  const Values cells = cells_.values();
  cells_.face_momentum.resize(n + 1);
  cells.left_edge() = faces.left_edge();
  for (std::size_t i = 0; i < n; ++i) cells.width(i) = faces.width(i);
  for (std::size_t f = 0; f <= n; ++f) cells_.face_momentum[f] = faces.momentum(f);
  const std::vector<double> momenta = staggered.cell_momenta(cells_.face_momentum);
  for (std::size_t i = 0; i < n; ++i) cells.momentum(i) = momenta[i];
  cells.dissipated() = faces.dissipated();
  cells.supplied() = faces.supplied();
  cells.through_ends() = faces.through_ends();
}

double Solver::step_implicitly(Work& work, double remaining, double crossing) {
  Staggered& staggered = this->staggered();
  if (!work.implicit_step)
    work.implicit_step =
        std::make_unique<Rodas4>(staggered.faces(), staggered.size(), Staggered::reach, bool(problem_.forcing));
  if (cells_.face_momentum.empty()) cells_.step = 0;
  const Rates f = [&staggered](double t, const double* z, double* dz) { staggered(t, z, dz); };
  const std::vector<double> z = faces_of_cells(staggered);
  std::vector<double> rate(z.size()), next(z.size()), scale(2 * staggered.faces());
  find_scale(crossing, work.scale);
  double fastest = 0;
  for (std::size_t i = 0; i < size(); ++i)
    if (cells_.charge[i] > 0) fastest = std::fmax(fastest, work.scale[size() + i] / cells_.charge[i]);
  constexpr double creep = 1e-6;  // of the mean speed so far: adds as little to slip
  staggered.viscous_below(creep * mean_speed());
  staggered.start_from(cells_.s);
  f(cells_.time, z.data(), rate.data());
  if (steep_from_rest()) {
    const Staggered::Terminal terminal = staggered.terminal(rate.data());
    if (terminal.velocity > 0) {
      fastest = terminal.momentum;
      staggered.viscous_below(creep * terminal.velocity);
    }
  }
  for (std::size_t face = 0; face < staggered.faces(); ++face) {
    const FaceValues at(scale.data(), staggered.faces());
    at.width_left_of(face) = work.scale[face == 0 ? 0 : face - 1];
    at.momentum(face) = std::fmax(staggered.charge_around(face) * fastest, smallest_scale);
  }
  constexpr double slow = 1e-4;
  work.implicit_step->linearise(f, cells_.time, z, rate, scale, steep() ? slow : 0);
  double dt = cells_.step > 0 ? cells_.step : std::fmin(crossing, 1 / equations_->largest_friction_rate());
  constexpr double far_too_short = 1e-3;
  while (true) {
    if (steep() && dt < far_too_short * std::fmin(crossing, remaining))
      return step_by_faces(z, scale, std::fmin(crossing, remaining));
    const double wanted = dt;
    dt = step_within(remaining, dt);
    double error = HUGE_VAL;
    try {
      const StepAttempt made = (*work.implicit_step)(
          f, cells_.time, dt, z, rate, {scale, problem_.tolerance, equations_->largest_friction_rate()}, next);
      if (made.succeeded) error = made.error;
    } catch (const NumericsError&) {  // a stage left the range of states: as good as a large error
    }
    const double factor = std::clamp(0.9 * std::pow(error, -0.25), 0.2, 4.0);
    if (error <= 1) {
      cells_.step = dt < wanted ? std::fmax(wanted, dt * factor) : dt * factor;
      cells_of_faces(staggered, next);
      cells_.s = staggered.s();
      return dt;
    }
    dt *= factor;
    if (!(cells_.time + dt > cells_.time))
      throw NumericsError("t = " + digits(cells_.time) + ": the time step fell below rounding");
    staggered.start_from(cells_.s);
  }
}

/// Serves friction so steep at rest that its slope does not show its force at the end of a step. Two halves of a
/// step are compared with the whole, and extrapolated to second order.
double Solver::step_by_faces(const std::vector<double>& z, const std::vector<double>& scale, double longest) {
  Staggered& staggered = this->staggered();
  staggered.viscous_below(0);
  const double of_momentum_least = 0.05;  // an error of momentum lasts for one friction time only
  std::vector<double> whole(z.size()), half(z.size()), next(z.size());
  for (double dt = longest;;) {
    double error = HUGE_VAL;
    try {
      staggered.start_from(cells_.s);
      staggered.split_step(cells_.time, dt, z.data(), whole.data());
      staggered.split_step(cells_.time, dt / 2, z.data(), half.data());
      staggered.split_step(cells_.time + dt / 2, dt / 2, half.data(), next.data());
      double sum = 0;
      const std::size_t faces = staggered.faces();
      const auto off = [&](std::size_t i) { return (next[i] - whole[i]) / std::fmax(scale[i], std::fabs(next[i])); };
      for (std::size_t f = 0; f < faces; ++f) {
        const double of_width = off(f), of_momentum = off(faces + f);
        sum += of_width * of_width;
        sum += of_momentum_least * of_momentum_least * of_momentum * of_momentum;
      }
      error = std::sqrt(sum / static_cast<double>(scale.size())) / problem_.explicit_tolerance;
      for (std::size_t i = 0; i < z.size(); ++i) next[i] += next[i] - whole[i];
      for (std::size_t i = 1; i < faces; ++i)
        if (!(next[i] > z[i] / 10) && z[i] > 0) error = HUGE_VAL;
    } catch (const NumericsError&) {  // a stage left the range of states
    }
    const double factor = error < HUGE_VAL ? std::clamp(0.9 / std::sqrt(error), 0.2, 4.0) : 0.2;
    if (error <= 1) {
      cells_.step = dt * factor;
      cells_of_faces(staggered, next);
      cells_.s = staggered.s();
      return dt;
    }
    dt *= factor;
    if (!(cells_.time + dt > cells_.time)) throw too_strong_forces(cells_.time);
  }
}

/// From the rates at the present time.
void Solver::look_for_crossing() {
  const std::size_t cell = equations_->crossing(cells_.time, cells_.unknowns.data());
  if (cell >= size()) return;
  cells_.crossing_time = cells_.time;
  cells_.crossing_position = left_face(cell) + cells_.width(cell) / 2;
}

/// Returns false if interrupted.
bool Solver::advance_until_gap_closes(double time, const std::function<bool()>& interrupted) {
  Semidiscrete& equations = *equations_;
  const std::size_t n = size();
  Work work(equations, n, cells_.unknowns.size());
  const bool by_parts = steps_by_parts();
  if (by_parts) work.memory_step = std::make_unique<MemoryStep>(problem_, n, cells_.unknowns.size());
  while (cells_.time < time && &equations == equations_.get()) {  // until the cells are others
    equations.wake();
    equations.start_from(cells_.s);  // as a resumed run does, whoever has looked at the equations since the last step
    work.f(cells_.time, cells_.unknowns.data(), work.rate.data());
    if (std::isnan(cells_.crossing_time)) look_for_crossing();
    const double remaining = std::fmin(std::fmin(time - cells_.time, problem_.longest_step), gaps_close_in(work.rate));
    double crossing = problem_.cfl * equations.crossing_time(cells_.unknowns.data(), work.rate.data());
    const double rate = by_parts ? friction_rate_by_parts() : equations.largest_friction_rate();
    const double friction_times = rate * equations.mean_crossing_time(cells_.unknowns.data());
    const bool stiff =
        !problem_.periodic && ((!by_parts && steep_from_rest()) ||
                               friction_times > (cells_.face_momentum.empty() ? stiff_above : stiff_below));
    if (!stiff && !by_parts)
      crossing = std::fmin(crossing, longest_in_friction_times / equations.largest_friction_rate());
    if (stiff && by_parts) equations.find_friction_rates();
    equations.let_rest(cells_.unknowns.data(), work.rate.data());
    const double dt = stiff      ? step_implicitly(work, remaining, crossing)
                      : by_parts ? step_by_parts(*work.memory_step, work.rate, remaining, crossing)
                                 : step_explicitly(work, remaining, crossing);
    equations.wake();
    cells_.time = dt == time - cells_.time ? time : cells_.time + dt;
    ++cells_.steps;
    close_gaps();
    adjust_ends();
    if (interrupted && interrupted()) return false;
  }
  return true;
}

}  // namespace slipfront::pulse
