// The dimensions that a law states for its parameters decide how it is scaled. These checks compare them with its
// force.

#include "friction/scaling.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "friction/laws/force_of_speed.hpp"
#include "math/digits.hpp"
#include "math/simd/vector_code.hpp"
#include "slipfront/error.hpp"

namespace slipfront::friction {
namespace {

/// Replaces the curve of a law that takes one. A table ends somewhere, a formula may fail; this curve does neither.
Curve probe_curve(const Definition& definition) {
  if (definition.curve == CurveSource::none) return {};
  return [](double speed) { return 0.5 + speed / (1 + speed); };
}

std::shared_ptr<const Law> probe_law(const Definition& definition, const std::vector<double>& values) {
  return definition.make(values, probe_curve(definition), {});
}

[[noreturn]] void refuse(const Definition& definition, const std::string& problem) {
  throw InputError({.key = "friction",
                    .value = std::string(definition.name),
                    .problem = problem,
                    .allowed = "a law whose definition states the Dimension of each parameter: of a force that of "
                               "strengths and of coefficients of the velocity"});
}

/// A law at one position, with its state.
struct Position {
  std::shared_ptr<const Law> law;
  std::vector<double> state;

  Position(const Friction& friction, std::shared_ptr<const Law> of)
      : law(std::move(of)), state(friction.definition().state.size()) {
    law->evolution().start(state);
  }
  void slip(double velocity, double time) { law->evolution().advance(Slip::at(velocity), time, state); }
  double force(double speed) const { return law->strength(speed, state); }
};

/// Compares forces at speeds from far below slow slip to far above earthquakes.
void compare_forces(const Definition& definition, const Position& original, const Position& scaled, double scale) {
  constexpr int slowest = -12, fastest = 1;  // powers of ten
  constexpr double tolerance = 1e-8, least = 1e-280;
  double worst = tolerance;
  std::string problem;
  for (int power = slowest - 1; power <= fastest; ++power) {
    const double speed = power < slowest ? 0 : std::pow(10.0, power);
    const double wanted = original.force(speed) / scale, force = scaled.force(speed);
    const double error = std::fabs(force - wanted) / (std::fabs(wanted) + least);
    if (!(error > worst)) continue;
    worst = error;
    problem = "on a chain of scale " + digits(scale) + " its force at w = " + digits(speed) + " is " + digits(force) +
              " in place of f / scale = " + digits(wanted);
  }
  if (!problem.empty()) refuse(definition, problem);
}

std::vector<double> values_of(const Friction& friction) {
  std::vector<double> values;
  for (const Parameter& p : friction.definition().parameters) values.push_back(friction.parameter(p.name));
  return values;
}

}  // namespace

void check_scaling(const Friction& original, const Friction& scaled, double scale) {
  const Definition& definition = original.definition();
  Position one(original, probe_law(definition, values_of(original)));
  Position stretched(scaled, probe_law(definition, values_of(scaled)));
  compare_forces(definition, one, stretched, scale);
  if (definition.state.empty()) return;
  struct History {
    double velocity, time;
  };
  for (const History& h : {History{0, 0.5}, {1e-3, 2}, {0.2, 1}, {3, 0.3}}) {
    one.slip(h.velocity, h.time);
    stretched.slip(h.velocity, scale * h.time);
    compare_forces(definition, one, stretched, scale);
  }
}

void check_no_force(const Definition& definition, const std::vector<double>& values) {
  const std::shared_ptr<const Law> law = probe_law(definition, values);
  std::vector<double> state(definition.state.size());
  law->evolution().start(state);
  for (const double speed : {0.0, 1e-3, 1.0})
    if (const double force = law->strength(speed, state); force > 0)
      refuse(definition, "its force at w = " + digits(speed) + " is " + digits(force, 6) +
                             ", but none of its parameters is a force > 0");
}

namespace {

/// Calls `task` with a position, a number of positions from it on, and their shares of the force, the last of their
/// variables. These are all positions if the shares are next to each other, or else parts of them.
template <class Task>
void with_shares(std::size_t size, LocalStates states, const Task& task) {
  double copies[part_size];
  if (states.next == 1) return task(0, size, states.column(states.each - 1, size, copies));
  in_parts(size, [&](std::size_t begin, std::size_t some) {
    task(begin, some, states.from(begin).column(states.each - 1, some, copies));
  });
}

/// Without the share.
template <class States>
States of_law(States states) {
  return states.first(states.each - 1);
}

class ScaledLoops final : public ForceLoops {
 public:
  ScaledLoops(const Law& law, const Law& one) : ForceLoops(law), one_(one) {}
  void strengths(std::size_t size, const double* speed, LocalStates states, double* force) const override {
    with_shares(size, states, [&](std::size_t begin, std::size_t some, const double* share) {
      one_.loops().strengths(some, speed + begin, of_law(states).from(begin), force + begin);
      multiply(some, share, force + begin);
    });
  }
  void speeds_after(std::size_t size, const double* free, double weight, LocalStates states,
                    double* speed) const override {
    with_shares(size, states, [&](std::size_t begin, std::size_t some, const double* share) {
      one_.loops().speeds_after_under(some, share, free + begin, weight, of_law(states).from(begin), speed + begin);
    });
  }
  void slow_steps(std::size_t size, const Steps& steps, const double* share, double weight, LocalStates states,
                  double* applied) const override {
    if (share != nullptr) return ForceLoops::slow_steps(size, steps, share, weight, states, applied);
    with_shares(size, states, [&](std::size_t begin, std::size_t some, const double* shares) {
      one_.loops().slow_steps(some, {steps.per_step, steps.from + begin, steps.next + begin}, shares, weight,
                              of_law(states).from(begin), applied == nullptr ? nullptr : applied + begin);
    });
  }
  void powers(std::size_t size, double per_step, const double* D, LocalStates states, double* power) const override {
    with_shares(size, states, [&](std::size_t begin, std::size_t some, const double* shares) {
      one_.loops().powers(some, per_step, D + begin, of_law(states).from(begin), power + begin);
      multiply(some, shares, power + begin);
    });
  }

 private:
  const Law& one_;
};

class ScaledRate final : public RelaxationRate {
 public:
  explicit ScaledRate(std::unique_ptr<RelaxationRate> one) : one_(std::move(one)) {}
  double operator()(const State& train, double contact, LocalState state) const override {
    return state.back() * (*one_)(train, contact, state.first(state.size() - 1));
  }

 private:
  std::unique_ptr<RelaxationRate> one_;
};

class ScaledAverage final : public TrainAverage {
 public:
  explicit ScaledAverage(const Law& one) : one_(one) {}
  double mean_strength(const State& train, double contact, Closure closure, LocalState state) const override {
    return state.back() * one_.average().mean_strength(train, contact, closure, state.first(state.size() - 1));
  }
  void mean_strengths(const Trains& trains, Closure closure, double* mean, double* slope) const override {
    with_shares(trains.size, trains.states, [&](std::size_t begin, std::size_t some, const double* share) {
      one_.average().mean_strengths({some, trains.fastest + begin, trains.s + begin, of_law(trains.states).from(begin)},
                                    closure, mean + begin, slope == nullptr ? nullptr : slope + begin);
      multiply(some, share, mean + begin);
      if (slope != nullptr) multiply(some, share, slope + begin);
    });
  }
  std::unique_ptr<RelaxationRate> relaxation_rate(Closure closure) const override {
    return std::make_unique<ScaledRate>(one_.average().relaxation_rate(closure));
  }

 private:
  const Law& one_;
};

class ScaledEvolution final : public StateEvolution {
 public:
  explicit ScaledEvolution(const Law& one) : one_(one.evolution()) {}
  void start(std::span<double> state) const override { one_.start(state.first(state.size() - 1)); }
  void advance(const Slip& slip, double time, std::span<double> state) const override {
    if (state.size() > 1) one_.advance(slip, time, state.first(state.size() - 1));
  }
  void advance_all(std::size_t size, const Slips& slips, double time, EvolvingStates states) const override {
    if (states.each > 1) one_.advance_all(size, slips, time, of_law(states));
  }

 private:
  const StateEvolution& one_;
};

class ScaledLaw final : public Law {
 public:
  explicit ScaledLaw(std::shared_ptr<const Law> one)
      : Law({.steep_at_rest = one->facts().steep_at_rest}),
        one_(std::move(one)),
        loops_(*this, *one_),
        average_(*one_),
        evolution_(*one_) {}
  double strength(double speed, LocalState state) const override {
    return state.back() * one_->strength(speed, state.first(state.size() - 1));
  }
  double speed_after(double free, double weight, LocalState state) const override {
    return one_->speed_after(free, weight * state.back(), state.first(state.size() - 1));
  }
  const ForceLoops& loops() const override { return loops_; }
  const TrainAverage& average() const override { return average_; }
  const StateEvolution& evolution() const override { return evolution_; }

 private:
  std::shared_ptr<const Law> one_;
  ScaledLoops loops_;
  ScaledAverage average_;
  ScaledEvolution evolution_;
};

}  // namespace

std::shared_ptr<const Law> scaled_law(std::shared_ptr<const Law> law) {
  return std::make_shared<ScaledLaw>(std::move(law));
}

}  // namespace slipfront::friction
