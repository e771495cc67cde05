#include "pulse/friction/friction_solve.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "foundation/math/roots.hpp"
#include "pulse/space/kernels.hpp"
#include "slipfront/modulation/per_dislocation.hpp"

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

}  // namespace slipfront::pulse
