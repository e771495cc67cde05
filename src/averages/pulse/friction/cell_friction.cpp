#include "averages/pulse/friction/cell_friction.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "averages/pulse/space/kernels.hpp"
#include "math/roots.hpp"
#include "slipfront/theory/modulation/modulation.hpp"

namespace slipfront::pulse {
namespace {

constexpr std::size_t lanes = 8;
constexpr double precision = 1e-12;  ///< relative, of the momentum; of the force if friction takes nearly all momentum
constexpr double at_rest_below = SlowedTrains::at_rest_below;

/// Finds x with excess(size e^x) = 0. We search in x, over which the force of a regularised law changes evenly.
template <class Excess>
double root_between(double low, double high, double at_low, double at_high, double size, const Excess& excess) {
  return root_of({.low = low, .high = high, .at_low = at_low, .at_high = at_high, .x = high}, precision * size, 1e-13,
                 1, [&](double x) { return excess(size * std::exp(x)); });
}

}  // namespace

SlowedTrain::Result SlowedTrain::after(double free, double time) const {
  const double size = std::fabs(free), weight = 2 * std::numbers::pi * time;
  if (size == 0) return {0, 0, 0};
  State state{};
  const auto excess = [&](double momentum) {
    state = modulation::state_of({contact * spacing, momentum / contact}, psi_guess);
    return momentum + weight * friction.mean_strength(state, contact, state_values) - size;
  };
  const auto with_sign = [&](double momentum) {
    return Result{std::copysign(momentum, free), std::copysign(std::tanh(state.phi), free),
                  contact * std::sinh(std::fabs(state.phi)) * std::exp(state.psi)};
  };
  const double at_slowest = excess(at_rest_below * size);
  if (at_slowest >= 0) return {0, 0, 0};
  const double at_size = excess(size);
  if (at_size <= precision * size) return with_sign(size);
  return with_sign(size * std::exp(root_between(std::log(at_rest_below), 0, at_slowest, at_size, size, excess)));
}

SlowedTrains::SlowedTrains(const friction::Friction& friction, std::size_t most)
    : friction_(friction), variables_(friction.state_size()), state_values_((most + lanes) * friction.state_size()) {
  states_.resize(most + lanes);  // padding for whole vectors
  cell_.resize(most + lanes);
  for (auto* array : {&contact_, &free_, &momentum_, &fastest_, &force_, &slope_, &next_, &velocity_, &typical_,
                      &next_force_, &last_})
    array->resize(most + lanes);
}

void SlowedTrains::copy(std::size_t from, std::size_t to) {
  cell_[to] = cell_[from];
  contact_[to] = contact_[from];
  free_[to] = free_[from];
  momentum_[to] = momentum_[from];
  states_.spacing[to] = states_.spacing[from];
  states_.s[to] = states_.s[from];
  for (std::size_t v = 0; v < variables_; ++v)
    state_values_[to * variables_ + v] = state_values_[from * variables_ + v];
}

/// Finds the states of the trains from their momenta, the mean forces and the slopes of the forces.
void SlowedTrains::evaluate() {
  std::size_t size = count_;
  for (; size % lanes != 0; ++size) copy(size - 1, size);
  for (std::size_t i = 0; i < size; ++i) states_.momentum[i] = momentum_[i] / contact_[i];
  states_.solve_slip(size, fastest_.data());
  for (std::size_t i = 0; i < size; ++i) fastest_[i] = states_.solved(i) ? contact_[i] * fastest_[i] : 1;
  friction_.average().mean_strengths({size, fastest_.data(), states_.s.data(), {state_values_.data(), variables_}},
                                     friction_.closure(), force_.data(), slope_.data());
}

SlowedTrain::Result SlowedTrains::solve_alone(std::size_t i, double time) const {
  const SlowedTrain train{friction_,
                          states_.spacing[i] / contact_[i],
                          contact_[i],
                          {state_values_.data() + i * variables_, variables_},
                          std::atanh(std::fmin(std::fmax(states_.s[i], 0.0), 1 - 1e-16))};
  return train.after(free_[i], time);
}

void SlowedTrains::solve(double time, const Results& results) {
  constexpr int most_steps = 60;
  constexpr double last_step = 3e-5;  // last change of ln M; the remaining error is of the order of its square
  const double weight = 2 * std::numbers::pi * time;
  const auto finish = [&](std::size_t i, const SlowedTrain::Result& as, double force) {
    const std::size_t cell = cell_[i];
    results.momentum[cell] = as.momentum;
    results.velocity[cell] = as.velocity;
    results.typical_speed[cell] = as.typical_speed;
    results.force[cell] = force;
    results.slope[cell] = slope_[i];
    results.s[cell] = states_.s[i];
  };
  for (int tries = 0; count_ > 0; ++tries) {
    evaluate();
    const NewtonArrays arrays{count_, momentum_.data(), free_.data(), force_.data(), slope_.data(), next_.data()};
    take_newton_steps(arrays, weight, at_rest_below);
    find_after_newton(arrays, weight, last_step, precision,
                      {states_.s.data(), states_.velocity.data(), fastest_.data(), velocity_.data(), typical_.data(),
                       next_force_.data(), last_.data()});
    std::size_t rest = 0;
    for (std::size_t i = 0; i < count_; ++i) {
      const double free = free_[i], M = momentum_[i];
      if (!states_.solved(i) || tries == most_steps) {
        const SlowedTrain::Result as = solve_alone(i, time);
        finish(i, as, (free - as.momentum) / weight);
      } else if (M <= at_rest_below * free && M + weight * force_[i] >= free) {
        finish(i, {0, 0, 0}, free / weight);
      } else if (last_[i] != 0) {
        finish(i, {next_[i], velocity_[i], typical_[i]}, next_force_[i]);
      } else {
        momentum_[i] = next_[i];
        copy(i, rest++);
      }
    }
    count_ = rest;
  }
}

using std::numbers::pi;

CellFriction::CellFriction(const Problem& problem, std::size_t cells)
    : problem_(problem), solve_(problem.friction, cells), state_(cells * problem.friction.state_size()) {
  for (auto* array : {&charge_, &x_, &contact_, &start_, &start_s_, &start_typical_, &start_momentum_, &start_force_,
                      &s_, &momentum_, &velocity_, &typical_, &force_, &slope_, &start_slope_})
    array->resize(cells);
  for (auto* array : {&strength_at_rest_, &held_, &free_, &guess_, &moves_, &spacing_, &middle_, &fastest_,
                      &friction_times_, &slipping_fastest_, &slipping_s_, &slipping_force_, &slipping_slope_})
    array->resize(cells);
  slipping_.resize(cells);
  slipping_state_.resize(state_.size());
}

void CellFriction::start(const Cells& cells, const CellStates& trains, CellRange awake, const StateGrid& grid) {
  awake_ = awake;
  charge_ = cells.charge;
  cells.find_centres(x_);
  start_ = trains.velocity;
  start_s_ = cells.s;
  for (std::size_t i = 0; i < x_.size(); ++i) {
    const bool gap = charge_[i] == 0;
    contact_[i] = contact(i);
    start_momentum_[i] = gap ? 0 : std::fabs(cells.momentum(i)) / charge_[i];
    if (gap) start_[i] = 0;
  }
  take_state(grid, cells.state, 0);
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

void CellFriction::find_passing(const Cells& cells, StateGrid::Passing& passing) const {
  passing.mean.resize(x_.size());
  passing.typical = typical_;
  for (std::size_t i = 0; i < x_.size(); ++i)  // W = k U
    passing.mean[i] = velocity_[i] * 2 * pi * charge_[i] / cells.width(i);
}

void CellFriction::take_state(const StateGrid& grid, const std::vector<double>& values, double dt) {
  const std::size_t first = awake_.begin, count = awake_.end - first;
  for (std::size_t i = first; i < awake_.end; ++i) middle_[i] = x_[i] + start_[i] * dt / 2;
  double* state = state_.data() + first * variables();
  grid.look_up(values, count, middle_.data() + first, state);
  std::fill(held_.begin(), held_.end(), 0.0);
  if (problem_.friction.sticks())
    problem_.friction.loops().strengths(count, held_.data(), {state, variables()}, strength_at_rest_.data() + first);
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
      solve_.add({i, spacing_[i], contact_[i], state_.data() + i * each, free_[i], guess_[i], s_[i]});
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
    std::copy_n(state_.data() + i * each, each, slipping_state_.data() + count * each);
    ++count;
  }
  problem_.friction.average().mean_strengths(
      {count, slipping_fastest_.data(), slipping_s_.data(), {slipping_state_.data(), each}},
      problem_.friction.closure(), slipping_force_.data(), slipping_slope_.data());
  for (std::size_t j = 0; j < count; ++j) {
    force_[slipping_[j]] = slipping_force_[j];
    slope_[slipping_[j]] = slipping_slope_[j];
  }
}

const std::vector<double>& CellFriction::friction_times(double time) {
  for (std::size_t i = 0; i < x_.size(); ++i)
    friction_times_[i] = momentum_[i] > 0 && slope_[i] > 0 ? 2 * pi * time * slope_[i] / momentum_[i] : 0;
  return friction_times_;
}

/// If friction balances the other forces, a change of friction changes the momentum for one friction time only.
double CellFriction::state_error(const std::vector<double>& forces_before, double time,
                                 const std::vector<double>& scale) {
  const std::size_t stride = std::max<std::size_t>(x_.size() / 64, 1);
  for (std::size_t i = 0; i < x_.size(); ++i) fastest_[i] = velocity_[i] == 0 ? 0 : 2 * typical_[i] / (1 + s_[i]);
  find_forces(s_, stride);
  double sum = 0;
  for (std::size_t i = 0; i < x_.size(); i += stride) {
    if (!(fastest_[i] > 0)) continue;
    const double off = 2 * pi * time / (1 + friction_times_[i]) * charge_[i] * (force_[i] - forces_before[i]) /
                       ConstValues(scale.data(), x_.size()).momentum(i);
    sum += off * off;
  }
  const double error = std::sqrt(sum * static_cast<double>(stride) / static_cast<double>(x_.size()));
  return std::isfinite(error) ? error : HUGE_VAL;
}

}  // namespace slipfront::pulse
