// Steps with friction that remembers: the memory of the places and the motion of the cells, each with the other's
// values in the middle of the step.

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

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

/// Friction on the cells over a step, from the memory of the places in its middle.
class CellFriction {
 public:
  CellFriction(const Problem& problem, const Cells& cells, const std::vector<State>& states)
      : problem_(problem), cells_(cells), x_(centres_of(cells)), memory_(cells.size() * variables()) {
    for (std::size_t i = 0; i < states.size(); ++i) {
      start_.push_back(std::tanh(states[i].phi));
      typical_.push_back(states[i].empty() ? 0 : typical_speed(states[i], contact(i)));
    }
    velocity_ = start_;
  }

  const std::vector<double>& x() const { return x_; }
  /// What passes over the places that these cells lie over, with the velocities as last found.
  Places::Passing passing(const Cells& cells) const { return {slip_velocities(cells, velocity_), typical_}; }

  /// Where the cells are in the middle of a step of `dt`.
  void take_memory(const Places& places, double dt) {
    for (std::size_t i = 0; i < x_.size(); ++i)
      places.look_up(x_[i] + start_[i] * dt / 2, memory_.data() + i * variables());
  }

  SplitStep::Left left(std::size_t cell, double width, double free, double time) {
    const double q = cells_.charge[cell];
    if (q == 0) return {free, 0};
    const SlowedTrain train{problem_.friction,          width / q,        contact(cell), memory(cell),
                            std::atanh(cells_.s[cell]), start_[cell] == 0};
    const SlowedTrain::Left of_one = train.after(free / q, time);
    velocity_[cell] = of_one.velocity;
    typical_[cell] = of_one.typical_speed;
    return {of_one.momentum * q, of_one.velocity};
  }

  /// Momentum that friction takes from each cell in a time, if it is in this state.
  std::vector<double> taken(const std::vector<State>& states, double time) const {
    std::vector<double> all(states.size());
    for (std::size_t i = 0; i < states.size(); ++i)
      if (!states[i].empty() && states[i].phi != 0)
        all[i] = 2 * pi * time * cells_.charge[i] * problem_.friction.mean_strength(states[i], contact(i), memory(i));
    return all;
  }

 private:
  std::size_t variables() const { return problem_.friction.variables(); }
  double contact(std::size_t cell) const { return problem_.contact ? problem_.contact(x_[cell]) : 1; }
  friction::Memory memory(std::size_t cell) const {
    return friction::Memory(memory_).subspan(cell * variables(), variables());
  }

  const Problem& problem_;
  const Cells cells_;  ///< at the start of the step
  std::vector<double> x_, memory_, start_, velocity_, typical_;
};

/// `share` of the way from what passes at one time to what passes at another, place by place.
Places::Passing between(const Places::Passing& from, const Places::Passing& to, double share) {
  Places::Passing mixed = from;
  for (std::size_t i = 0; i < mixed.mean.size(); ++i) {
    mixed.mean[i] = std::lerp(from.mean[i], to.mean[i], share);
    mixed.typical[i] = std::lerp(from.typical[i], to.typical[i], share);
  }
  return mixed;
}

/// What the step has got wrong by taking the memory in its middle as the slip velocity of its start foretold it: in
/// units of `scale`, root mean square over the cells.
double memory_error(const std::vector<double>& foretold, const std::vector<double>& found,
                    const std::vector<double>& scale) {
  double sum = 0;
  for (std::size_t i = 0; i < found.size(); ++i) {
    const double off = (found[i] - foretold[i]) / scale[Values::momentum_at(i)];
    sum += off * off;
  }
  return std::sqrt(sum / static_cast<double>(found.size()));
}

}  // namespace

Places Solver::places() const {
  Places all(problem_.friction, problem_.left, problem_.right, static_cast<std::size_t>(problem_.cells));
  if (!cells_.memory.empty()) all.values() = cells_.memory;
  return all;
}

double Solver::step_with_memory(const std::vector<double>& rate, double remaining, double crossing) {
  const friction::Law& law = problem_.friction.law();
  const Rates f = [this](double t, const double* y, double* dy) { (*equations_)(t, y, dy); };
  SplitStep step(size(), cells_.unknowns.size());
  CellFriction friction(problem_, cells_, equations_->states());
  const auto left = [&](std::size_t cell, double width, double free, double time) {
    return friction.left(cell, width, free, time);
  };
  const std::vector<double> before = cells_.unknowns;
  const Places now = places();
  const Places::Passing at_start = now.passing(friction.x(), friction.passing(cells_));
  std::vector<double> scale(2 * size());
  find_scale(crossing, scale);
  const double longest = SplitStep::longest_in_crossing_times * crossing;
  double dt = next_step(remaining, cells_.step > 0 ? std::fmin(longest, cells_.step) : longest);
  for (int tries = 0;; ++tries) {
    double factor = 0.5;
    try {
      Places half = now, better = now, after = now;
      half.advance(law, at_start, dt / 2);
      friction.take_memory(half, dt);
      step(f, left, cells_.time, dt, cells_.unknowns, rate);
      const std::vector<double> foretold = friction.taken(equations_->states(), dt);
      const Places::Passing at_end = now.passing(centres_of(cells_), friction.passing(cells_));
      better.advance(law, between(at_start, at_end, 0.25), dt / 2);
      after.advance(law, between(at_start, at_end, 0.5), dt);
      friction.take_memory(better, dt);
      const double of_memory = memory_error(foretold, friction.taken(equations_->states(), dt), scale);
      const double error =
          std::max({step.error(cells_.unknowns, scale, equations_->shocked()), of_memory, unseen_push(dt)}) /
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
    if (tries == 80) throw too_strong_forces(cells_.time);
    cells_.unknowns = before;
    equations_->start_from(cells_.s);
    dt *= factor;
  }
  cells_.s = equations_->s();
  return dt;
}

}  // namespace slipfront::pulse
