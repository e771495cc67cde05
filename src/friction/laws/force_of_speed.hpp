#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "math/simd/vector_code.hpp"
#include "slipfront/friction/law.hpp"

namespace slipfront::friction {

template <class Force>
SLIPFRONT_CLONES void forces_at(Force force, std::size_t size, const double* speed, double* f) {
  SLIPFRONT_INDEPENDENT
  for (std::size_t i = 0; i < size; ++i) f[i] = force(speed[i]);
}

/// A law whose force depends on the speed only. `Force` is made from the values of the parameters, and its operator()
/// gives f. The same expression becomes vector code for many positions, so it calls no function that has none.
template <class Force>
class ForceOfSpeed final : public Law {
 public:
  explicit ForceOfSpeed(const std::vector<double>& values) : force_(values), loops_(*this, force_) {}
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

/// Positions in one pass of the loops over many positions, whose values then fit into the nearest cache.
constexpr std::size_t part_size = 64;

/// Calls `task` with the first position of each part and its size, at most `part_size`.
template <class Task>
void in_parts(std::size_t size, const Task& task) {
  for (std::size_t begin = 0; begin < size; begin += part_size) task(begin, std::min(part_size, size - begin));
}

}  // namespace slipfront::friction
