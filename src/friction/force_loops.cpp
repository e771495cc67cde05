// The force at many positions, by the force at one.

#include <algorithm>
#include <cstddef>

#include "foundation/simd/vector_code.hpp"
#include "friction/laws/in_parts.hpp"
#include "slipfront/friction/law.hpp"

namespace slipfront::friction {
namespace {

/// Many solves of v + weight f(v) = free at once, by secants. `before` and `excess` are the last v and the excess of
/// the left side there; `open` is 1 until v is found to rounding.
struct Secants {
  double v[part_size], before[part_size], excess[part_size], open[part_size], weight[part_size];
};

/// Starts at v = free, where the force is `force`; `at_rest` is what holds a position at rest.
SLIPFRONT_CLONES void start_secants(std::size_t size, const double* free, const double* at_rest, const double* force,
                                    Secants& s) {
  SLIPFRONT_INDEPENDENT
  for (std::size_t i = 0; i < size; ++i) {
    const double weight = s.weight[i], slowed = free[i] - weight * force[i];
    const bool held = weight * at_rest[i] >= free[i], found = held || slowed == free[i];
    s.before[i] = free[i];
    s.excess[i] = weight * force[i];
    s.v[i] = held ? 0 : slowed > 0 ? slowed : free[i] / 2;
    s.open[i] = found ? 0.0 : 1.0;
  }
}

/// One step of each from the force at v. The error of a secant is the product of the errors of its two points.
SLIPFRONT_CLONES void take_secants(std::size_t size, const double* free, const double* force, Secants& s) {
  constexpr double rounding = 4e-16;
  SLIPFRONT_INDEPENDENT
  for (std::size_t i = 0; i < size; ++i) {
    const double v = s.v[i], excess = v + s.weight[i] * force[i] - free[i];
    const double way = v - s.before[i], next = v - excess * (way / (excess - s.excess[i])), step = next - v;
    const double error = excess > 0 ? excess : -excess, left = step / v * (way / v);
    const bool there = error <= rounding * free[i], inside = next > 0 && next < free[i];
    const bool open = s.open[i] != 0, moves = open && !there && inside;
    s.open[i] = open && !there && !(inside && left <= rounding && left >= -rounding) ? 1.0 : 0.0;
    s.before[i] = v;
    s.excess[i] = excess;
    s.v[i] = moves ? next : v;
  }
}

}  // namespace

void ForceLoops::strengths(std::size_t size, const double* speed, LocalStates states, double* force) const {
  for (std::size_t i = 0; i < size; ++i) force[i] = law_.strength(speed[i], states.at(i));
}

void ForceLoops::speeds_after(std::size_t size, const double* free, double weight, LocalStates states,
                              double* speed) const {
  double share[part_size];
  std::fill_n(share, part_size, 1.0);
  in_parts(size, [&](std::size_t begin, std::size_t some) {
    ForceLoops::speeds_after_under(some, share, free + begin, weight, states.from(begin), speed + begin);
  });
}

void ForceLoops::speeds_after_under(std::size_t size, const double* share, const double* free, double weight,
                                    LocalStates states, double* speed) const {
  constexpr int most_steps = 6;
  Secants s;
  double at_rest[part_size], force[part_size];
  in_parts(size, [&](std::size_t begin, std::size_t some) {
    const LocalStates theirs = states.from(begin);
    std::fill_n(s.v, some, 0.0);
    for (std::size_t i = 0; i < some; ++i) s.weight[i] = weight * share[begin + i];
    strengths(some, s.v, theirs, at_rest);
    strengths(some, free + begin, theirs, force);
    start_secants(some, free + begin, at_rest, force, s);
    for (int step = 0; step < most_steps && std::find(s.open, s.open + some, 1.0) != s.open + some; ++step) {
      strengths(some, s.v, theirs, force);
      take_secants(some, free + begin, force, s);
    }
    for (std::size_t i = 0; i < some; ++i)
      speed[begin + i] = s.open[i] == 0 ? s.v[i] : law_.speed_after(free[begin + i], s.weight[i], theirs.at(i));
  });
}

}  // namespace slipfront::friction
