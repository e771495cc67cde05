#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <tuple>
#include <utility>
#include <vector>

#include "math/simd/vector_code.hpp"
#include "slipfront/friction/law.hpp"

namespace slipfront::friction {

/// Positions in one pass of the loops over many positions, whose values then fit into the nearest cache.
constexpr std::size_t part_size = 64;

/// Calls `task` with the first position of each part and its size, at most `part_size`.
template <class Task>
void in_parts(std::size_t size, const Task& task) {
  for (std::size_t begin = 0; begin < size; begin += part_size) task(begin, std::min(part_size, size - begin));
}

/// Calls `task` with the first position of each part, its size, and the first state variable there, which it changes.
template <class Task>
void change_in_parts(std::size_t size, EvolvingStates states, const Task& task) {
  double copies[part_size];
  in_parts(size, [&](std::size_t begin, std::size_t some) {
    const EvolvingStates part = states.from(begin);
    double* const values = part.column(0, some, copies);
    task(begin, some, values);
    for (std::size_t i = 0; i < some && values == copies; ++i) part(i, 0) = values[i];
  });
}

/// The first `count` parameters at a part of the positions, for a law with parameters that vary.
template <std::size_t count>
class ParametersOfPart {
 public:
  ParametersOfPart(const std::vector<double>& values, const Varying& varying) : varying_(varying) {
    for (std::size_t p = 0; p < count; ++p) {
      std::fill_n(copies_[p], part_size, values[p]);
      at_[p] = copies_[p];
    }
  }
  void take(LocalStates part, std::size_t size) {
    for (std::size_t c = 0; c < varying_.parameters.size(); ++c)
      if (const std::size_t p = varying_.parameters[c]; p < count)
        at_[p] = part.column(varying_.own + c, size, copies_[p]);
  }
  const std::array<const double*, count>& at() const { return at_; }

 private:
  const Varying& varying_;
  std::array<const double*, count> at_;  ///< by parameter, then by position
  double copies_[count][part_size];      ///< numbers that are not next to each other already
};

// A `Force` is made from its `Values`, an array of the parameters of a law, and its operator() gives f at a speed, or
// at another number on which f depends. The same expression becomes vector code for many positions, so it calls no
// function that has none.

template <class Force>
Force force_with(const std::vector<double>& values) {
  typename Force::Values these;
  std::copy_n(values.begin(), these.size(), these.begin());
  return Force(these);
}

template <class Force>
SLIPFRONT_CLONES void forces_at(Force force, std::size_t size, const double* speed, double* f) {
  SLIPFRONT_INDEPENDENT
  for (std::size_t i = 0; i < size; ++i) f[i] = force(speed[i]);
}

template <class Force, std::size_t... p>
SLIPFRONT_CLONES void varying_forces(std::array<const double*, sizeof...(p)> at, std::index_sequence<p...>,
                                     std::size_t size, const double* speed, double* f) {
  SLIPFRONT_INDEPENDENT
  for (std::size_t i = 0; i < size; ++i) f[i] = Force({at[p][i]...})(speed[i]);
}

/// f at each speed, where parameters vary.
template <class Force>
void forces_where_they_vary(const std::vector<double>& values, const Varying& varying, std::size_t size,
                            const double* speed, LocalStates states, double* f) {
  constexpr std::size_t count = std::tuple_size_v<typename Force::Values>;
  ParametersOfPart<count> parameters(values, varying);
  in_parts(size, [&](std::size_t begin, std::size_t some) {
    parameters.take(states.from(begin), some);
    varying_forces<Force>(parameters.at(), std::make_index_sequence<count>(), some, speed + begin, f + begin);
  });
}

template <class Force>
class VaryingForceOfSpeed;

/// A law whose force depends on the speed only.
template <class Force>
class ForceOfSpeed final : public Law {
 public:
  using WhereItVaries = VaryingForceOfSpeed<Force>;
  explicit ForceOfSpeed(const std::vector<double>& values) : force_(force_with<Force>(values)), loops_(*this, force_) {}
  double strength(double speed, LocalState) const override { return force_(speed); }
  const ForceLoops& loops() const override { return loops_; }

 private:
  class Loops final : public ForceLoops {
   public:
    Loops(const Law& law, const Force& force) : ForceLoops(law), force_(force) {}
    void strengths(std::size_t size, const double* speed, LocalStates, double* force) const override {
      forces_at(force_, size, speed, force);
    }

   private:
    Force force_;
  };
  Force force_;
  Loops loops_;
};

template <class Force>
class VaryingForceOfSpeed final : public VaryingLaw<ForceOfSpeed<Force>> {
 public:
  using VaryingLaw<ForceOfSpeed<Force>>::VaryingLaw;
  const ForceLoops& loops() const override { return loops_; }

 private:
  class Loops final : public ForceLoops {
   public:
    explicit Loops(const VaryingForceOfSpeed& law) : ForceLoops(law), all_(law) {}
    void strengths(std::size_t size, const double* speed, LocalStates states, double* force) const override {
      forces_where_they_vary<Force>(all_.values(), all_.varying(), size, speed, states, force);
    }

   private:
    const VaryingForceOfSpeed& all_;
  };
  Loops loops_{*this};
};

template <class Closed>
SLIPFRONT_CLONES void closed_forces(double C, std::size_t size, const double* speed, double* force) {
  SLIPFRONT_INDEPENDENT
  for (std::size_t i = 0; i < size; ++i) force[i] = Closed::force(C, speed[i]);
}
template <class Closed>
SLIPFRONT_CLONES void closed_speeds(double s, std::size_t size, const double* share, const double* free,
                                    double* speed) {
  SLIPFRONT_INDEPENDENT
  for (std::size_t i = 0; i < size; ++i) speed[i] = Closed::slowed(share == nullptr ? s : s * share[i], free[i]);
}

/// Vector code of a law for which the speed after friction has a closed form. With its coefficient C, `force(C, w)` is
/// f, and `slowed(s, free)` solves v + s f(v) / C = free.
template <class Closed>
class ClosedLoops final : public ForceLoops {
 public:
  ClosedLoops(const Law& law, double coefficient) : ForceLoops(law), C_(coefficient) {}
  void strengths(std::size_t size, const double* speed, LocalStates, double* force) const override {
    closed_forces<Closed>(C_, size, speed, force);
  }
  void speeds_after(std::size_t size, const double* free, double weight, LocalStates, double* speed) const override {
    closed_speeds<Closed>(weight * C_, size, nullptr, free, speed);
  }
  void speeds_after_under(std::size_t size, const double* share, const double* free, double weight, LocalStates,
                          double* speed) const override {
    closed_speeds<Closed>(weight * C_, size, share, free, speed);
  }

 private:
  double C_;
};

}  // namespace slipfront::friction
