// Steps with friction that remembers: the memory of the places and the motion of the cells, each with the other's
// values in the middle of the step.

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "../digits.hpp"
#include "friction_solve.hpp"
#include "places.hpp"
#include "semidiscrete.hpp"
#include "slipfront/error.hpp"
#include "slipfront/pulse/solver.hpp"
#include "split_step.hpp"

namespace slipfront::pulse {
namespace {

using std::numbers::pi;

/// Centres of the cells.
std::vector<double> centres_of(const Cells& cells) {
  std::vector<double> x(cells.size());
  double face = cells.left_edge();
  for (std::size_t i = 0; i < cells.size(); ++i) {
    x[i] = face + cells.width(i) / 2;
    face += cells.width(i);
  }
  return x;
}

/// W = k U; 0 in a gap.
std::vector<double> slip_velocities(const Cells& cells, const std::vector<double>& dislocation_velocities) {
  std::vector<double> W(cells.size());
  for (std::size_t i = 0; i < cells.size(); ++i)
    W[i] = dislocation_velocities[i] * 2 * pi * cells.charge[i] / cells.width(i);
  return W;
}

}  // namespace

Places Solver::places() const {
  Places all(problem_.friction, problem_.left, problem_.right, static_cast<std::size_t>(problem_.cells));
  if (!cells_.memory.empty()) all.values() = cells_.memory;
  return all;
}

double Solver::step_with_memory(const std::vector<double>& rate, double remaining, double crossing) {
  const friction::Friction& friction = problem_.friction;
  const std::size_t n = size();
  const Rates f = [this](double t, const double* y, double* dy) { (*equations_)(t, y, dy); };
  SplitStep step(n, cells_.unknowns.size());
  std::vector<double> velocity(n), memory(n * friction.variables()), scale(2 * n);
  const std::vector<State> states = equations_->states();
  for (std::size_t i = 0; i < n; ++i) velocity[i] = std::tanh(states[i].phi);
  const std::vector<double> x = centres_of(cells_), before = cells_.unknowns, start = velocity;
  const Places now = places();
  const std::vector<double> W = now.velocity_from(x, slip_velocities(cells_, start));
  find_scale(crossing, scale);
  const double longest = SplitStep::longest_in_crossing_times * crossing;
  double dt = next_step(remaining, cells_.step > 0 ? std::fmin(longest, cells_.step) : longest);
  for (int tries = 0;; ++tries) {
    Places half = now;
    half.advance(friction.law(), W, dt / 2);
    for (std::size_t i = 0; i < n; ++i)
      half.look_up(x[i] + start[i] * dt / 2, memory.data() + i * friction.variables());
    const auto contact_of = [&](std::size_t i) { return problem_.contact ? problem_.contact(x[i]) : 1.0; };
    const auto left_by_friction = [&](std::size_t i, double width, double free, double time) -> SplitStep::Left {
      const double q = cells_.charge[i];
      if (q == 0) return {free, 0};
      const SlowedTrain train{friction,
                              width / q,
                              contact_of(i),
                              friction::Memory(memory).subspan(i * friction.variables(), friction.variables()),
                              std::atanh(cells_.s[i]),
                              start[i] == 0};
      const SlowedTrain::Left left = train.after(free / q, time);
      velocity[i] = left.velocity;
      return {left.momentum * q, left.velocity};
    };
    double factor = 0.5;
    try {
      step(f, left_by_friction, cells_.time, dt, cells_.unknowns, rate);
      Places after = now, middle = now;
      const std::vector<double> W_after = now.velocity_from(centres_of(cells_), slip_velocities(cells_, velocity));
      std::vector<double> mean(W.size()), early(W.size());
      for (std::size_t j = 0; j < W.size(); ++j) {
        mean[j] = (W[j] + W_after[j]) / 2;
        early[j] = (3 * W[j] + W_after[j]) / 4;
      }
      after.advance(friction.law(), mean, dt);
      middle.advance(friction.law(), early, dt / 2);
      const double error = std::fmax(step.error(cells_.unknowns, scale, equations_->shocked()), unseen_push(dt)) /
                           problem_.explicit_tolerance;
      factor = std::clamp(0.9 * std::pow(error, -1.0 / 3), 0.2, 4.0);
      if (error <= 1) {
        cells_.step = dt * factor;
        cells_.memory = after.values();
        break;
      }
    } catch (const NumericsError&) {
      if (tries == 80) throw;
    }
    if (tries == 80)
      throw NumericsError("t = " + digits(cells_.time) +
                          ": the time step failed: the forces on a cell exceed what any step can resolve");
    cells_.unknowns = before;
    equations_->start_from(cells_.s);
    dt *= factor;
  }
  cells_.s = equations_->s();
  return dt;
}

}  // namespace slipfront::pulse
