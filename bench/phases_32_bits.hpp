#pragma once
// Steps of a chain with phases of 32 bits, and in doubles. An integer counts 2^-32 of a turn, so sums of phases are
// exact, and overflow reduces the argument of the sine. With d2 y = y_left + y_right - 2 y, the step of kernel.hpp is
//     next = z + before (z - z_old) + spread d2 y - (force + 2 spread coupled) S.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <new>
#include <optional>
#include <utility>
#include <vector>

#include "lattice/chain/explicit/levels/scheme.hpp"
#include "math/simd/vector_code.hpp"

namespace phases {

using namespace slipfront;
using namespace slipfront::chain;
using Phase = std::uint32_t;

constexpr double units = 4294967296.0;  // in a turn

[[gnu::always_inline]] inline float number(Phase p) { return static_cast<float>(static_cast<std::int32_t>(p)); }
/// The nearest whole number of units, modulo a turn.
[[gnu::always_inline]] inline Phase whole(float x) {
#if defined(__GNUC__) && !defined(__clang__)
  return static_cast<Phase>(__builtin_irintf(x));  // one instruction of vector code
#else
  return static_cast<Phase>(static_cast<int>(std::lrint(x)));
#endif
}

/// An allocator of whole cache lines.
template <class T>
struct InLines {
  using value_type = T;
  T* allocate(std::size_t n) { return static_cast<T*>(::operator new (n * sizeof(T), std::align_val_t{64})); }
  void deallocate(T* p, std::size_t) { ::operator delete (p, std::align_val_t{64}); }
  bool operator==(const InLines&) const { return true; }
};
template <class T>
using Row = std::vector<T, InLines<T>>;

constexpr std::size_t lanes_32 = 16;  ///< the number of sites is a multiple of this

/// LevelRule in single precision; S is in units.
struct Rule32 {
  float c[PeriodicForce::terms], eps, coupled, force, damping, spread, rest;

  explicit Rule32(const Scheme& scheme) : Rule32(scheme.rule, scheme.eps) {}
  Rule32(const LevelRule& r, double eps_of_z)
      : eps(static_cast<float>(eps_of_z)),
        coupled(static_cast<float>(r.coupled)),
        force(static_cast<float>(r.force + 2 * r.spread * r.coupled)),
        damping(static_cast<float>(1 - r.before)),
        spread(static_cast<float>(r.spread)),
        rest(static_cast<float>(1 - r.spread)) {
    for (int k = 0; k < PeriodicForce::terms; ++k) c[k] = static_cast<float>(r.f.c[k] * units);
  }

  [[gnu::always_inline]] float S(Phase z) const {
    const float r = number(z) * static_cast<float>(1 / units), square = r * r;
    float p = c[PeriodicForce::terms - 1];
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC unroll 16
#endif
    for (int k = PeriodicForce::terms - 2; k >= 0; --k) p = p * square + c[k];
    return r * p;
  }
};

/// Two levels of z and the rule of their steps. Both ends are fixed.
class Stepper {
 public:
  virtual ~Stepper() = default;
  virtual void advance(long steps) = 0;
  virtual void phases(std::vector<double>& z) const = 0;  ///< z now, in turns
  virtual Levels levels() const = 0;
  /// The sum of D^2 + B^2 / 12 over all steps and sites, if it is measured; in turns.
  virtual std::optional<double> squares() const { return {}; }
};

template <class Real>
[[gnu::always_inline]] inline void real_step(const LevelRule& rule, std::size_t n, const Real* now, Real* old,
                                             Real* y) {
  Real c[PeriodicForce::terms];
  for (int k = 0; k < PeriodicForce::terms; ++k) c[k] = static_cast<Real>(rule.f.c[k]);
  const Real coupled = static_cast<Real>(rule.coupled), keep = static_cast<Real>(rule.keep),
             force = static_cast<Real>(rule.force), before = static_cast<Real>(rule.before),
             spread = static_cast<Real>(rule.spread);
  SLIPFRONT_INDEPENDENT
  for (std::size_t j = 0; j < n; ++j) {
    constexpr Real magic = sizeof(Real) == 8 ? static_cast<Real>(6755399441055744.0) : static_cast<Real>(12582912.0);
    const Real z = now[j], r = z - ((z + magic) - magic), square = r * r;
    Real p = c[PeriodicForce::terms - 1];
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC unroll 16
#endif
    for (int k = PeriodicForce::terms - 2; k >= 0; --k) p = p * square + c[k];
    const Real S = r * p;
    y[j] = z - coupled * S;
    old[j] = (keep * z - force * S) - before * old[j];
  }
  SLIPFRONT_INDEPENDENT
  for (std::size_t j = 0; j < n; ++j) old[j] += spread * (y[j - 1] + y[j + 1]);
}
SLIPFRONT_CLONES inline void step_of(const LevelRule& r, std::size_t n, const double* now, double* old, double* y) {
  real_step(r, n, now, old, y);
}
SLIPFRONT_CLONES inline void step_of(const LevelRule& r, std::size_t n, const float* now, float* old, float* y) {
  real_step(r, n, now, old, y);
}

/// z and z_old as floating-point numbers.
template <class Real>
class Reals final : public Stepper {
 public:
  Reals(const Levels& s, const Scheme& scheme)
      : rule_(scheme.rule),
        now_(s.now.begin(), s.now.end()),
        old_(s.before.begin(), s.before.end()),
        y_(s.now.size() + 2 * lanes_32) {}
  void advance(long steps) override {
    const std::size_t n = now_.size();
    for (long i = 0; i < steps; ++i, ++level_) {
      const Real left = now_[0], right = now_[n - 1];
      step_of(rule_, n, now_.data(), old_.data(), y_.data() + lanes_32);
      old_[0] = left;
      old_[n - 1] = right;
      now_.swap(old_);
    }
  }
  void phases(std::vector<double>& z) const override { z.assign(now_.begin(), now_.end()); }
  Levels levels() const override { return {level_, {now_.begin(), now_.end()}, {old_.begin(), old_.end()}}; }

 private:
  LevelRule rule_;
  Row<Real> now_, old_, y_;
  long level_ = 0;
};

/// Adds the second difference of y to the next z.
[[gnu::always_inline]] inline void add_neighbours(const Rule32& r, std::size_t n, const Phase* y, Phase* next) {
  SLIPFRONT_INDEPENDENT
  for (std::size_t j = 0; j < n; ++j) {
    const Phase bend = y[j - 1] + y[j + 1] - 2 * y[j];
    next[j] += bend - whole(r.rest * number(bend));
  }
}

SLIPFRONT_CLONES inline void step_of(const Rule32& rule, std::size_t n, const Phase* now, Phase* old, Phase* y) {
  const Rule32 r = rule;
  SLIPFRONT_INDEPENDENT
  for (std::size_t j = 0; j < n; ++j) {
    const Phase z = now[j], D = z - old[j];
    const float S = r.S(z);
    y[j] = z - whole(r.coupled * S);
    old[j] = z + D - whole(r.force * S + r.damping * number(D));
  }
  add_neighbours(r, n, y, old);
}

constexpr std::size_t vectors_of_sum = 64;

/// Like step_of, and returns the sum of D^2 + B^2 / 12 for the step that led to `now` (squares()). It keeps u and D.
SLIPFRONT_CLONES inline double step_with_work(const Rule32& rule, std::size_t n, const Phase* now, Phase* old, Phase* y,
                                              Phase* u, Phase* step) {
  const Rule32 r = rule;
  double sum = 0;
  for (std::size_t first = 0; first < n; first += lanes_32 * vectors_of_sum) {
    float part[lanes_32] = {};
    const std::size_t end = std::min(n, first + lanes_32 * vectors_of_sum);
    for (std::size_t i = first; i < end; i += lanes_32) {
      SLIPFRONT_INDEPENDENT
      for (std::size_t k = 0; k < lanes_32; ++k) {
        const std::size_t j = i + k;
        const Phase z = now[j], before = z - old[j];
        const float S = r.S(z);
        y[j] = z - whole(r.coupled * S);
        old[j] = z + before - whole(r.force * S + r.damping * number(before));
        const Phase at = z - whole(r.eps * S), D = at - u[j], B = D - step[j];
        part[k] += number(D) * number(D) + number(B) * number(B) * (1.0F / 12);
        u[j] = at;
        step[j] = D;
      }
    }
    for (const float p : part) sum += static_cast<double>(p);
  }
  add_neighbours(r, n, y, old);
  return sum;
}

/// Keeps in `part` what rounding leaves of each change of z - z_old, for the next step.
SLIPFRONT_CLONES inline void step_with_remainder(const Rule32& rule, std::size_t n, const Phase* now, Phase* old,
                                                 Phase* y, float* part) {
  const Rule32 r = rule;
  SLIPFRONT_INDEPENDENT
  for (std::size_t j = 0; j < n; ++j) {
    const Phase z = now[j], D = z - old[j];
    const float S = r.S(z);
    y[j] = z - whole(r.coupled * S);
    old[j] = z + D;
    part[j] -= r.force * S + r.damping * number(D);
  }
  SLIPFRONT_INDEPENDENT
  for (std::size_t j = 0; j < n; ++j) {
    const Phase bend = y[j - 1] + y[j + 1] - 2 * y[j];
    const float change = part[j] - r.rest * number(bend);
    const Phase rounded = whole(change);
    old[j] += bend + rounded;
    part[j] = change - number(rounded);
  }
}

/// `step` has z - z_old in units, and `old` becomes the next z.
SLIPFRONT_CLONES inline void step_with_float(const Rule32& rule, std::size_t n, const Phase* now, Phase* old, Phase* y,
                                             float* step) {
  const Rule32 r = rule;
  SLIPFRONT_INDEPENDENT
  for (std::size_t j = 0; j < n; ++j) {
    const float S = r.S(now[j]);
    y[j] = now[j] - whole(r.coupled * S);
    step[j] -= r.force * S + r.damping * step[j];
  }
  SLIPFRONT_INDEPENDENT
  for (std::size_t j = 0; j < n; ++j) {
    step[j] += r.spread * number(y[j - 1] + y[j + 1] - 2 * y[j]);
    old[j] = now[j] + whole(step[j]);
  }
}

enum class Steps { whole, measured, remainder, floating };

/// z as integers. The steps z - z_old are integers too, without or with a remainder, or single precision.
template <Steps kind>
class Phases final : public Stepper {
 public:
  Phases(const Levels& s, const Scheme& scheme) : rule_(scheme), left_(s.now[0]), part_(s.now.size()) {
    for (std::size_t j = 0; j < s.now.size(); ++j) {
      for (const auto& [to, z] : {std::pair{&now_, s.now[j]}, {&old_, s.before[j]}})
        to->push_back(static_cast<Phase>(std::llround((z - std::floor(z)) * units)));
      if (kind == Steps::floating) part_[j] = static_cast<float>((s.now[j] - s.before[j]) * units);
    }
    y_.resize(now_.size() + 2 * lanes_32);
    if (kind != Steps::measured) return;
    for (const Phase z : now_) u_.push_back(z - whole(rule_.eps * rule_.S(z)));
    step_.resize(u_.size());
  }
  void advance(long steps) override {
    const std::size_t n = now_.size();
    for (long i = 0; i < steps; ++i, ++level_) {
      const Phase left = now_[0], right = now_[n - 1];
      if constexpr (kind == Steps::whole) step_of(rule_, n, now_.data(), old_.data(), y_.data() + lanes_32);
      if constexpr (kind == Steps::measured)
        sum_ += step_with_work(rule_, n, now_.data(), old_.data(), y_.data() + lanes_32, u_.data(), step_.data());
      if constexpr (kind == Steps::remainder)
        step_with_remainder(rule_, n, now_.data(), old_.data(), y_.data() + lanes_32, part_.data());
      if constexpr (kind == Steps::floating)
        step_with_float(rule_, n, now_.data(), old_.data(), y_.data() + lanes_32, part_.data());
      part_[0] = part_[n - 1] = 0;
      old_[0] = left;
      old_[n - 1] = right;
      now_.swap(old_);
    }
  }
  std::optional<double> squares() const override {
    if (kind != Steps::measured) return {};
    Phases next = *this;  // it measures the step that led to the present level
    next.advance(1);
    return next.sum_ / (units * units);
  }
  /// Neighbours differ by less than half a turn.
  void phases(std::vector<double>& z) const override {
    z.resize(now_.size());
    z[0] = left_;
    for (std::size_t j = 1; j < z.size(); ++j)
      z[j] = z[j - 1] + static_cast<std::int32_t>(now_[j] - now_[j - 1]) / units;
  }
  Levels levels() const override {
    Levels l{level_, {}, {}};
    phases(l.now);
    l.before = l.now;
    for (std::size_t j = 0; j < now_.size(); ++j) l.before[j] -= static_cast<std::int32_t>(now_[j] - old_[j]) / units;
    return l;
  }

 private:
  Rule32 rule_;
  double left_;
  Row<float> part_;
  Row<Phase> now_, old_, y_;
  Row<Phase> u_, step_;  ///< u, and the step to it, at the level before
  double sum_ = 0;
  long level_ = 0;
};

}  // namespace phases
