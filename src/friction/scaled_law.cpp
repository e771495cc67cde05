#include "friction/scaled_law.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

#include "friction/laws/in_parts.hpp"

namespace slipfront::friction {
namespace {

/// The states of a part of the positions, taken apart into those of the law and the shares.
class Apart {
 public:
  Apart(std::size_t size, LocalStates states) : own_(states.each - 1) {
    thread_local std::vector<double> values;  // kept between calls, which then allocate nothing
    values.resize(part_size * own_);
    law_ = values.data();
    for (std::size_t i = 0; i < size; ++i) {
      const LocalState state = states.at(i);
      std::copy_n(state.begin(), own_, law_ + i * own_);
      share[i] = state.back();
    }
  }
  LocalStates law() const { return {law_, own_}; }
  double* law_values() { return law_; }
  double share[part_size];

 private:
  std::size_t own_;
  double* law_;
};

class ScaledLoops final : public ForceLoops {
 public:
  ScaledLoops(const Law& law, const Law& one) : ForceLoops(law), one_(one) {}
  void strengths(std::size_t size, const double* speed, LocalStates states, double* force) const override {
    in_parts(size, [&](std::size_t begin, std::size_t some) {
      const Apart at(some, states.from(begin));
      one_.loops().strengths(some, speed + begin, at.law(), force + begin);
      for (std::size_t i = 0; i < some; ++i) force[begin + i] *= at.share[i];
    });
  }
  void speeds_after(std::size_t size, const double* free, double weight, LocalStates states,
                    double* speed) const override {
    in_parts(size, [&](std::size_t begin, std::size_t some) {
      const Apart at(some, states.from(begin));
      one_.loops().speeds_after_under(some, at.share, free + begin, weight, at.law(), speed + begin);
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
    in_parts(trains.size, [&](std::size_t begin, std::size_t some) {
      const Apart at(some, trains.states.from(begin));
      one_.average().mean_strengths({some, trains.fastest + begin, trains.s + begin, at.law()}, closure, mean + begin,
                                    slope == nullptr ? nullptr : slope + begin);
      for (std::size_t i = 0; i < some; ++i) {
        mean[begin + i] *= at.share[i];
        if (slope != nullptr) slope[begin + i] *= at.share[i];
      }
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
  void advance_all(std::size_t size, const Slips& slips, double time, std::size_t each, double* state) const override {
    if (each == 1) return;
    const std::size_t own = each - 1;
    in_parts(size, [&](std::size_t begin, std::size_t some) {
      double* const to = state + begin * each;
      Apart at(some, {to, each});
      one_.advance_all(some, {slips.mean + begin, slips.typical + begin}, time, own, at.law_values());
      for (std::size_t i = 0; i < some; ++i) std::copy_n(at.law_values() + i * own, own, to + i * each);
    });
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
