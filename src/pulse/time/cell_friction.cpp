// Steps that take friction cell by cell, where it remembers or is steep at rest: the memory of the places and the
// motion of the cells, each with the other's values in the middle of the step.

#include "pulse/time/cell_friction.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "foundation/math/step_control.hpp"
#include "pulse/space/kernels.hpp"
#include "pulse/time/step_limits.hpp"
#include "slipfront/error.hpp"

namespace slipfront::pulse {
namespace {

using std::numbers::pi;

/// Centres of the cells.
void find_centres(const Cells& cells, std::vector<double>& x) {
  double face = cells.left_edge();
  for (std::size_t i = 0; i < cells.size(); ++i) {
    x[i] = face + cells.width(i) / 2;
    face += cells.width(i);
  }
}

/// `share` of the way from what passes at one time to what passes at another, place by place.
Places::Passing between(const Places::Passing& from, const Places::Passing& to, double share) {
  Places::Passing mixed = from;
  for (std::size_t i = 0; i < mixed.mean.size(); ++i) {
    mixed.mean[i] += share * (to.mean[i] - from.mean[i]);
    mixed.typical[i] += share * (to.typical[i] - from.typical[i]);
  }
  return mixed;
}

}  // namespace

CellFriction::CellFriction(const Problem& problem, std::size_t cells)
    : problem_(problem), solve_(problem.friction, cells), memory_(cells * problem.friction.state_size()) {
  for (auto* array : {&charge_, &x_, &contact_, &start_, &start_s_, &start_typical_, &start_momentum_, &start_force_,
                      &s_, &momentum_, &velocity_, &typical_, &force_, &slope_, &start_slope_})
    array->resize(cells);
  for (auto* array : {&strength_at_rest_, &held_, &free_, &guess_, &moves_, &spacing_, &middle_, &fastest_,
                      &slipping_fastest_, &slipping_s_, &slipping_force_, &slipping_slope_})
    array->resize(cells);
  slipping_.resize(cells);
  slipping_memory_.resize(memory_.size());
}

void CellFriction::start(const Cells& cells, const CellStates& trains, Stretch awake, const Places& places) {
  awake_ = awake;
  charge_ = cells.charge;
  find_centres(cells, x_);
  start_ = trains.velocity;
  start_s_ = cells.s;
  for (std::size_t i = 0; i < x_.size(); ++i) {
    const bool gap = charge_[i] == 0;
    contact_[i] = contact(i);
    start_momentum_[i] = gap ? 0 : std::fabs(cells.momentum(i)) / charge_[i];
    if (gap) start_[i] = 0;
  }
  take_memory(places, 0);
  fastest_slip(x_.size(), trains.phi.data(), trains.psi.data(), fastest_.data());
  for (std::size_t i = 0; i < x_.size(); ++i) fastest_[i] = charge_[i] == 0 ? 0 : contact_[i] * fastest_[i];
  find_forces(trains.s);
  start_force_ = force_;
  start_slope_ = slope_;
  for (std::size_t i = 0; i < x_.size(); ++i) start_typical_[i] = fastest_[i] / 2 * (1 + trains.s[i]);
  restart();
}

void CellFriction::restart() {
  s_ = start_s_;
  momentum_ = start_momentum_;
  velocity_ = start_;
  typical_ = start_typical_;
  force_ = start_force_;
  slope_ = start_slope_;
}

Places::Passing CellFriction::passing(const Cells& cells) const {
  Places::Passing passing{std::vector<double>(x_.size()), typical_};
  for (std::size_t i = 0; i < x_.size(); ++i)  // W = k U
    passing.mean[i] = velocity_[i] * 2 * pi * charge_[i] / cells.width(i);
  return passing;
}

void CellFriction::take_memory(const Places& places, double dt) {
  const std::size_t first = awake_.begin, count = awake_.end - first;
  for (std::size_t i = first; i < awake_.end; ++i) middle_[i] = x_[i] + start_[i] * dt / 2;
  double* memory = memory_.data() + first * variables();
  places.look_up(count, middle_.data() + first, memory);
  std::fill(held_.begin(), held_.end(), 0.0);
  if (problem_.friction.sticks())
    problem_.friction.loops().strengths(count, held_.data(), {memory, variables()}, strength_at_rest_.data() + first);
}

void CellFriction::operator()(const double* y, const double* free, double time, double* momentum, double* velocity) {
  const double weight = 2 * pi * time;
  const std::size_t each = variables();
  solve_.clear();
  const std::size_t first = awake_.begin, count = awake_.end - first;
  for (std::size_t i = first; i < awake_.end; ++i) held_[i] = weight * strength_at_rest_[i];
  const auto part = [first](std::vector<double>& array) { return array.data() + first; };
  free_momenta({count, part(charge_), part(contact_), ConstValues(y, x_.size()).widths() + first, free + first,
                part(s_), part(held_), part(momentum_), part(free_), part(guess_), part(moves_), part(spacing_)},
               time);
  // From the momentum, the force and its slope as last found.
  take_newton_steps({count, part(guess_), part(free_), part(force_), part(slope_), part(guess_)}, weight,
                    SlowedTrains::at_rest_below);
  for (std::size_t i = first; i < awake_.end; ++i) {
    if (moves_[i] != 0) {
      solve_.add({i, spacing_[i], contact_[i], memory_.data() + i * each, free_[i], guess_[i], s_[i]});
    } else {
      momentum_[i] = std::isnan(free_[i]) ? free_[i] : 0;
      velocity_[i] = typical_[i] = force_[i] = slope_[i] = 0;
    }
  }
  solve_.solve(time, {momentum_.data(), velocity_.data(), typical_.data(), force_.data(), slope_.data(), s_.data()});
  std::copy_n(free, first, momentum);  // a gap's, or nothing
  std::copy(free + awake_.end, free + x_.size(), momentum + awake_.end);
  std::fill_n(velocity, x_.size(), 0.0);
  for (std::size_t i = first; i < awake_.end; ++i) {
    momentum[i] = charge_[i] == 0 ? free[i] : std::copysign(momentum_[i], free[i]) * charge_[i];
    velocity_[i] = std::copysign(velocity_[i], free[i]);
    velocity[i] = velocity_[i];
  }
}

/// Mean forces, and their slopes, of the cells that slip, or of one in `stride`, from their largest slip velocities and
/// s.
void CellFriction::find_forces(const std::vector<double>& s, std::size_t stride) {
  const std::size_t each = variables();
  std::size_t count = 0;
  for (std::size_t i = 0; i < x_.size(); i += stride) {
    force_[i] = slope_[i] = 0;
    if (!(fastest_[i] > 0)) continue;
    slipping_[count] = i;
    slipping_fastest_[count] = fastest_[i];
    slipping_s_[count] = s[i];
    std::copy_n(memory_.data() + i * each, each, slipping_memory_.data() + count * each);
    ++count;
  }
  problem_.friction.average().mean_strengths(
      {count, slipping_fastest_.data(), slipping_s_.data(), {slipping_memory_.data(), each}},
      problem_.friction.closure(), slipping_force_.data(), slipping_slope_.data());
  for (std::size_t j = 0; j < count; ++j) {
    force_[slipping_[j]] = slipping_force_[j];
    slope_[slipping_[j]] = slipping_slope_[j];
  }
}

void CellFriction::foretell(std::vector<double>& force) const { force = force_; }

double CellFriction::memory_error(const std::vector<double>& foretold, double time, const std::vector<double>& scale) {
  const std::size_t stride = std::max<std::size_t>(x_.size() / 64, 1);
  for (std::size_t i = 0; i < x_.size(); ++i) fastest_[i] = velocity_[i] == 0 ? 0 : 2 * typical_[i] / (1 + s_[i]);
  find_forces(s_, stride);
  double sum = 0;
  for (std::size_t i = 0; i < x_.size(); i += stride) {
    if (!(fastest_[i] > 0)) continue;
    const double off =
        2 * pi * time * charge_[i] * (force_[i] - foretold[i]) / ConstValues(scale.data(), x_.size()).momentum(i);
    sum += off * off;
  }
  const double error = std::sqrt(sum * static_cast<double>(stride) / static_cast<double>(x_.size()));
  return std::isfinite(error) ? error : HUGE_VAL;
}

Places Solver::places() const {
  Places all(problem_.friction, problem_.left, problem_.right, static_cast<std::size_t>(problem_.cells));
  if (!cells_.memory.empty()) all.values() = cells_.memory;
  return all;
}

double Solver::step_by_parts(MemoryStep& work, const std::vector<double>& rate, double remaining, double crossing) {
  const friction::StateEvolution& evolution = problem_.friction.evolution();
  const bool remembers = problem_.friction.state_size() > 0;
  if (!cells_.face_momentum.empty()) {
    cells_.face_momentum.clear();
    cells_.step = 0;
  }
  const Rates f = [this](double t, const double* y, double* dy) { (*equations_)(t, y, dy); };
  CellFriction& friction = work.friction;
  const auto slow = [&friction](const double* y, const double* free, double time, double* momentum, double* velocity) {
    friction(y, free, time, momentum, velocity);
  };
  work.before = cells_.unknowns;
  const Places now = places();
  friction.start(cells_, equations_->trains(), equations_->awake(), now);
  Places::Passing at_start;
  if (remembers) at_start = now.passing(friction.x(), friction.passing(cells_));
  std::vector<double> x(size());
  find_scale(crossing, work.scale);
  const double longest = Ars443::longest_in_crossing_times * crossing;
  double dt = step_within(remaining, cells_.step > 0 ? std::fmin(longest, cells_.step) : longest);
  for (int tries = 0;; ++tries) {
    double factor = 0.5;
    try {
      Places half = now, better = now, after = now;
      if (remembers) half.advance(evolution, at_start, dt / 2);
      friction.take_memory(half, dt);
      work.split(f, slow, cells_.time, dt, cells_.unknowns, rate);
      double of_memory = 0;
      if (remembers) {
        find_centres(cells_, x);
        const Places::Passing at_end = now.passing(x, friction.passing(cells_));
        friction.foretell(work.foretold);
        better.advance(evolution, between(at_start, at_end, 0.25), dt / 2);
        after.advance(evolution, between(at_start, at_end, 0.5), dt);
        friction.take_memory(better, dt);
        of_memory = friction.memory_error(work.foretold, dt, work.scale);
      }
      const double error =
          std::max({work.split.error(cells_.unknowns, work.scale, equations_->shocked()), of_memory, unseen_push(dt)}) /
          problem_.explicit_tolerance;
      const bool jumped = cells_jump(work.before, cells_.unknowns, cells_.charge);
      factor = std::clamp(0.9 * std::pow(error, -1.0 / 3), 0.2, jumped ? 0.5 : 4.0);
      if (error <= 1 && !jumped) {
        cells_.step = dt * factor;
        if (remembers) cells_.memory = after.values();
        break;
      }
    } catch (const NumericsError&) {
      if (tries == 80) throw;
    }
    if (tries == 80) throw too_strong_forces(cells_.time);
    cells_.unknowns = work.before;
    equations_->start_from(cells_.s);
    friction.restart();
    dt *= factor;
  }
  cells_.s = equations_->s();
  return dt;
}

}  // namespace slipfront::pulse
