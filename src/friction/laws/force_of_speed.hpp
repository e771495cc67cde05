#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <tuple>
#include <utility>
#include <vector>

#include "math/simd/elementary.hpp"
#include "math/simd/vector_code.hpp"
#include "slipfront/friction/law.hpp"

namespace slipfront::friction {

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

/// Lets the law find each force that is NaN, because it is outside the range of the vector code.
inline void find_others(const Law& law, std::size_t size, const double* speed, LocalStates states, double* f) {
  for (std::size_t i = 0; i < size; ++i)
    if (std::isnan(f[i])) f[i] = law.strength(speed[i], states.at(i));
}

/// The law L, whose force is `Force` at a speed, with parameters that vary. A `Force` that has limits is NaN outside
/// of them.
template <class L, class Force>
class VaryingForce final : public VaryingLaw<L> {
 public:
  using VaryingLaw<L>::VaryingLaw;
  const ForceLoops& loops() const override { return loops_; }

 private:
  class Loops final : public ForceLoops {
   public:
    explicit Loops(const VaryingForce& law) : ForceLoops(law), all_(law) {}
    void strengths(std::size_t size, const double* speed, LocalStates states, double* force) const override {
      forces_where_they_vary<Force>(all_.values(), all_.varying(), size, speed, states, force);
      if constexpr (requires { Force::has_limits; }) find_others(law_, size, speed, states, force);
    }

   private:
    const VaryingForce& all_;
  };
  Loops loops_{*this};
};

/// A law whose force depends on the speed only.
template <class Force>
class ForceOfSpeed final : public Law {
 public:
  using WhereItVaries = VaryingForce<ForceOfSpeed, Force>;
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

/// The speed of a step, which counts as 0 if it is a rounding error.
SLIPFRONT_INLINE double free_speed(double per_step, double from, double next) {
  const double step = std::fabs(next - from), scale = std::fabs(from);
  return step <= 8 * 2.2e-16 * (scale > 1e-3 ? scale : 1e-3) ? 0.0 : step * per_step;
}
/// The end of a step that goes the way of `step` at this speed. NaN stays NaN.
SLIPFRONT_INLINE double end_of_step(double step_per_speed, double from, double step, double speed) {
  return from + (std::copysign(speed * step_per_speed, step) + 0 * step);
}

// A law has a closed form if, with its coefficient C, f is `force(C, w)` and v + s f(v) / C = free has one. This is
// `slowed(s, free)`, or v / free is `left(s free)` with s = weight C, and `left_little` is its series for s free below
// `little`.
template <class Closed>
concept HasLeft = requires {
  Closed::left(1.0, 1.0);
};
template <class Closed>
concept HasSeries = requires {
  Closed::little;
};

template <class Closed>
SLIPFRONT_INLINE double share_left(double s, double free) {
  if constexpr (HasSeries<Closed>)
    return s * free < Closed::little ? Closed::left_little(s * free) : Closed::left(s, free);
  else
    return Closed::left(s, free);
}
template <class Closed>
SLIPFRONT_INLINE double slowed(double s, double free) {
  if constexpr (HasLeft<Closed>)
    return free * share_left<Closed>(s, free);
  else
    return Closed::slowed(s, free);
}

template <class Closed>
SLIPFRONT_CLONES void closed_forces(double C, std::size_t size, const double* speed, double* force) {
  SLIPFRONT_INDEPENDENT
  for (std::size_t i = 0; i < size; ++i) force[i] = Closed::force(C, speed[i]);
}
template <class Closed>
SLIPFRONT_CLONES void closed_powers(double C, std::size_t size, double per_step, const double* D, double* power) {
  SLIPFRONT_INDEPENDENT
  for (std::size_t i = 0; i < size; ++i) {
    const double speed = std::fabs(D[i]) * per_step;
    power[i] = speed * Closed::force(C, speed);
  }
}
template <class Closed>
SLIPFRONT_CLONES void closed_speeds(double s, std::size_t size, const double* share, const double* free,
                                    double* speed) {
  SLIPFRONT_INDEPENDENT
  for (std::size_t i = 0; i < size; ++i) speed[i] = slowed<Closed>(share == nullptr ? s : s * share[i], free[i]);
}
/// `applied(i, free, speed, step)` is called with the speeds before and after friction.
template <class Closed, class Applied>
[[gnu::always_inline]] inline void each_closed_step(double s, std::size_t size, const Steps& steps, const double* share,
                                                    const Applied& applied) {
  const double *const from = steps.from, per_step = steps.per_step, step_per_speed = 1 / per_step;
  double* const next = steps.next;
  SLIPFRONT_INDEPENDENT
  for (std::size_t i = 0; i < size; ++i) {
    const double step = next[i] - from[i], free = std::fabs(step) * per_step, s_here = share ? s * share[i] : s;
    const double speed = slowed<Closed>(s_here, free);
    if constexpr (HasLeft<Closed>)
      next[i] = from[i] + step * share_left<Closed>(s_here, free);
    else
      next[i] = end_of_step(step_per_speed, from[i], step, speed);
    applied(i, free, speed, step);
  }
}
template <class Closed>
SLIPFRONT_CLONES void closed_steps(double s, std::size_t size, const Steps& steps, const double* share,
                                   double per_weight, double* applied) {
  if (applied == nullptr)
    each_closed_step<Closed>(s, size, steps, share, [](std::size_t, double, double, double) {});
  else
    each_closed_step<Closed>(s, size, steps, share, [=](std::size_t i, double free, double speed, double step) {
      applied[i] = std::copysign((free - speed) * per_weight, step);
    });
}
/// Slows steps by the series. Returns whether it serves all of them; if not, it leaves them as they are.
template <class Closed>
SLIPFRONT_CLONES bool little_steps(double s, std::size_t size, const Steps& steps, const double* share) {
  const double *const from = steps.from, per_step = steps.per_step;
  double *const next = steps.next, before[part_size];
  std::size_t others = 0;
  SLIPFRONT_INDEPENDENT
  for (std::size_t i = 0; i < size; ++i) {
    const double step = next[i] - from[i], speed = std::fabs(step) * per_step, s_here = share ? s * share[i] : s;
    const double lost = s_here * speed;
    others += lost < Closed::little ? 0u : 1u;
    before[i] = next[i];
    next[i] = from[i] + step * Closed::left_little(lost);
  }
  if (others > 0) std::copy_n(before, size, next);
  return others == 0;
}

/// Vector code of such a law.
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
  void slow_steps(std::size_t size, const Steps& all, const double* share, double weight, LocalStates,
                  double* applied) const override {
    const double strength = weight * C_;
    const auto slow = [&](std::size_t begin, std::size_t some) {
      const Steps steps{all.per_step, all.from + begin, all.next + begin};
      const double* const here = share == nullptr ? nullptr : share + begin;
      if constexpr (HasSeries<Closed>)
        if (applied == nullptr && little_steps<Closed>(strength, some, steps, here)) return;
      closed_steps<Closed>(strength, some, steps, here, 1 / weight, applied == nullptr ? nullptr : applied + begin);
    };
    if constexpr (HasSeries<Closed>)
      in_parts(size, slow);
    else
      slow(0, size);
  }
  void powers(std::size_t size, double per_step, const double* D, LocalStates, double* power) const override {
    closed_powers<Closed>(C_, size, per_step, D, power);
  }

 private:
  double C_;
};

}  // namespace slipfront::friction
