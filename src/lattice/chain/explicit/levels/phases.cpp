#include "lattice/chain/explicit/levels/phases.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <utility>

#include "math/simd/vector_code.hpp"

namespace slipfront::chain {
namespace {

constexpr double units = 4294967296.0;       // a turn has this many
constexpr std::size_t wide = 2 * lanes;      // numbers of 32 bits in a vector
constexpr std::size_t ahead = wide - lanes;  // so that the first site of a tile begins a vector

std::size_t whole_vectors(std::size_t size) { return (size + wide - 1) / wide * wide; }

[[gnu::always_inline]] inline float number(Phase p) { return static_cast<float>(static_cast<std::int32_t>(p)); }
/// The nearest whole number of units.
[[gnu::always_inline]] inline Phase whole(float x) {
#if defined(__GNUC__) && !defined(__clang__)
  return static_cast<Phase>(__builtin_irintf(x));  // one instruction of vector code
#else
  return static_cast<Phase>(static_cast<int>(std::lrint(x)));
#endif
}
[[gnu::always_inline]] inline Phase phase_of(double z) {
  constexpr double last_bit = 1572864.0;  // 1.5 * 2^20: added to a part of a turn, the last bit is a unit
  return static_cast<Phase>(std::bit_cast<std::uint64_t>(part_of_turn(z) + last_bit));
}

[[gnu::always_inline]] inline float force(const PhaseRule& rule, Phase z) {
  const float r = number(z) * static_cast<float>(1 / units), square = r * r;
  float p = rule.c[PeriodicForce::terms - 1];
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC unroll 16
#endif
  for (int k = PeriodicForce::terms - 2; k >= 0; --k) p = p * square + rule.c[k];
  return r * p;
}

/// D and B of a site (StepOfU).
struct Steps {
  float D, B;
};

/// The arrays of the loops.
struct Arrays {
  const Phase* now;
  Phase *old, *y;
  float *shift, *D;  ///< z - u at the level before, and the step of u to it

  /// The part of the next level that depends on the site, in place of the level before; returns S.
  [[gnu::always_inline]] float step(const PhaseRule& rule, Phase moved, std::size_t j) const {
    const Phase z = now[j];
    const float S = force(rule, z);
    y[j] = z - whole(rule.coupled * S);
    old[j] = z + moved - whole(rule.force * S + rule.damping * number(moved));
    return S;
  }
  /// Keeps z - u and the step of u to this level, of which z has `moved`. Returns the two parts of its measure.
  [[gnu::always_inline]] Steps keep(const PhaseRule& rule, Phase moved, float S, std::size_t j) const {
    const float of_level = rule.eps * S, step = number(moved) - (of_level - shift[j]), bend = step - D[j];
    shift[j] = of_level;
    D[j] = step;
    return {step, bend};
  }
};

SLIPFRONT_CLONES void local_part(const PhaseRule& rule, const Arrays& arrays, std::size_t begin, std::size_t end) {
  const PhaseRule r = rule;
  const Arrays a = arrays;
  const std::size_t size = (end - begin) / lanes * lanes;
  SLIPFRONT_INDEPENDENT
  for (std::size_t i = 0; i < size; ++i) a.step(r, a.now[begin + i] - a.old[begin + i], begin + i);
}

template <bool whole_bend>
[[gnu::always_inline]] inline void add_bends(float factor, const Phase* y, Phase* next, std::size_t size) {
  const Phase *const left = y - 1, *const right = y + 1;
  SLIPFRONT_INDEPENDENT
  for (std::size_t j = 0; j < size; ++j) {
    const Phase bend = left[j] + right[j] - 2 * y[j];
    next[j] += (whole_bend ? bend : 0) + whole(factor * number(bend));
  }
}

/// Adds spread d2 y. Reads y from begin - 1 to end.
SLIPFRONT_CLONES void add_neighbours(const PhaseRule& rule, const Phase* y, Phase* next, std::size_t begin,
                                     std::size_t end) {
  const std::size_t size = (end - begin) / lanes * lanes;
  if (rule.whole_bend)
    add_bends<true>(rule.bend, y + begin, next + begin, size);
  else
    add_bends<false>(rule.bend, y + begin, next + begin, size);
}

/// Sums of D^2 and of B^2 over the sites of each block, by lanes, with D and B of site(j).
template <class Site>
[[gnu::always_inline]] inline void each_sum(const BlockSums& to, float* sums, const Site& site) {
  for (std::size_t i = 0; i < to.blocks; ++i) {
    const std::size_t begin = to.begin(i), until = to.begin(i + 1);
    const bool half_first = to.half_first && i == 0, half_last = to.half_last && i + 1 == to.blocks;
    float of_D[wide] = {}, of_B[wide] = {};
    const auto add = [&](std::size_t j, std::size_t k, float weight) __attribute__((always_inline)) {
      const Steps steps = site(j + k);
      of_D[k] += weight * steps.D * steps.D;
      of_B[k] += weight * steps.B * steps.B;
    };
    const auto add_odd = [&](std::size_t j) __attribute__((always_inline)) {
      SLIPFRONT_INDEPENDENT
      for (std::size_t k = 0; k < lanes; ++k) {
        const bool half = (half_first && j + k == begin) || (half_last && j + k + 1 == until);
        add(j, k, j + k >= until ? 0.0F : half ? 0.5F : 1.0F);
      }
    };
    std::size_t j = begin;
    if (half_first) {
      add_odd(j);
      j += lanes;
    }
    const std::size_t even = (half_last ? until - 1 : until) / lanes * lanes;
    for (; j + wide <= even; j += wide) {
      SLIPFRONT_INDEPENDENT
      for (std::size_t k = 0; k < wide; ++k) add(j, k, 1);
    }
    for (; j < until; j += lanes) add_odd(j);
    std::memcpy(sums + 2 * wide * i, of_D, sizeof of_D);
    std::memcpy(sums + 2 * wide * i + wide, of_B, sizeof of_B);
  }
}

/// Adds them to the sums of blocks, times `factor`.
SLIPFRONT_CLONES void add_sums(const float* sums, double factor, const BlockSums& to) {
  const std::size_t blocks = to.blocks, stride = to.stride;
  double* all = to.sums;
  for (std::size_t i = 0; i < blocks; ++i, all += stride, sums += 2 * wide) {
    const float *of_D = sums, *of_B = sums + wide;
    SLIPFRONT_INDEPENDENT
    for (std::size_t k = 0; k < lanes; ++k) {
      const double D2 = static_cast<double>(of_D[k]) + static_cast<double>(of_D[k + lanes]);
      const double B2 = static_cast<double>(of_B[k]) + static_cast<double>(of_B[k + lanes]);
      all[k] += factor * (D2 + B2 * (1.0 / 12));
    }
  }
}

SLIPFRONT_CLONES void local_part_with_work(const PhaseRule& rule, const Arrays& arrays, const BlockSums& to,
                                           float* sums) {
  const PhaseRule r = rule;
  const Arrays a = arrays;
  each_sum(
      to, sums, [&](std::size_t j) __attribute__((always_inline)) {
        const Phase moved = a.now[j] - a.old[j];
        return a.keep(r, moved, a.step(r, moved, j), j);
      });
}

/// z - u.
SLIPFRONT_CLONES void shifts(const PhaseRule& rule, const Phase* z, float* shift, std::size_t size) {
  const PhaseRule r = rule;
  SLIPFRONT_INDEPENDENT
  for (std::size_t j = 0; j < size; ++j) shift[j] = r.eps * force(r, z[j]);
}

SLIPFRONT_CLONES void to_phases(const double* z, Phase* phases, std::size_t size) {
  SLIPFRONT_INDEPENDENT
  for (std::size_t j = 0; j < size; ++j) phases[j] = phase_of(z[j]);
}

/// z of consecutive sites in turns, at two levels. `first` is that of the first site now, in units, with whole turns.
SLIPFRONT_CLONES void to_turns(std::int64_t first, const Phase* phases, const Phase* phases_before, double* before,
                               double* now, std::size_t size) {
  for (std::size_t j = 0; j < size; ++j) {
    now[j] = std::bit_cast<double>(first);
    first += static_cast<std::int32_t>(phases[j + 1] - phases[j]);
  }
  SLIPFRONT_INDEPENDENT
  for (std::size_t j = 0; j < size; ++j) {
    now[j] = static_cast<double>(std::bit_cast<std::int64_t>(now[j])) / units;
    before[j] = now[j] - static_cast<std::int32_t>(phases[j] - phases_before[j]) / units;
  }
}

/// Whether z of sites [begin, end) and the next, and at two levels, differ by less than 0.45 turns.
SLIPFRONT_CLONES bool follow(const Phase* now, const Phase* old, std::size_t begin, std::size_t end) {
  constexpr Phase most = static_cast<Phase>(0.45 * units);
  Phase bad = 0;
  for (std::size_t j = begin; j < end; ++j) {
    const Phase along = now[j + 1] - now[j] + most, in_time = now[j] - old[j] + most;
    bad |= along >= 2 * most || in_time >= 2 * most ? 1u : 0u;
  }
  return bad == 0;
}

}  // namespace

PhaseRule::PhaseRule(const Scheme& scheme)
    : eps(static_cast<float>(scheme.eps)),
      coupled(static_cast<float>(scheme.rule.coupled)),
      force(static_cast<float>(scheme.rule.force + 2 * scheme.rule.spread * scheme.rule.coupled)),
      damping(static_cast<float>(1 - scheme.rule.before)),
      whole_bend(scheme.rule.spread > 0.5),
      bend(static_cast<float>(scheme.rule.spread - (whole_bend ? 1 : 0))) {
  for (int k = 0; k < PeriodicForce::terms; ++k) c[k] = static_cast<float>(scheme.rule.f.c[k] * units);
}

PhaseTile::PhaseTile(const Scheme& scheme, std::size_t room, bool measures)
    : rule_(scheme),
      measures_(measures),
      arrays_{AlignedArray<Phase>(room + 2 * wide), AlignedArray<Phase>(room + 2 * wide),
              AlignedArray<Phase>(room + 2 * wide)},
      of_steps_{AlignedArray<float>(measures ? room + 2 * wide : ahead),
                AlignedArray<float>(measures ? room + 2 * wide : ahead)},
      now_(arrays_[0].data() + ahead),
      old_(arrays_[1].data() + ahead),
      y_(arrays_[2].data() + ahead),
      shift_(of_steps_[0].data() + ahead),
      D_(of_steps_[1].data() + ahead) {}

void PhaseTile::load(const double* before, const double* now, Range all, Range own) {
  own_ = own;
  to_phases(now + all.begin, now_ + all.begin, all.end - all.begin);
  to_phases(before + all.begin, old_ + all.begin, all.end - all.begin);
  if (measures_) shifts(rule_, old_ + own.begin, shift_ + own.begin, whole_vectors(own.end - own.begin));
  const auto near = static_cast<std::int64_t>(std::llrint(now[own.begin] * units));
  first_ = near + static_cast<std::int32_t>(now_[own.begin] - static_cast<Phase>(near));
}

void PhaseTile::advance(const EndConditions& ends, Range sites, const StepOfU& measured) {
  const std::size_t begin = own_.begin - whole_vectors(is_end(ends.left) ? 0 : own_.begin + 1 - sites.begin);
  const std::size_t end = own_.begin + whole_vectors((is_end(ends.right) ? sites.end : sites.end + 1) - own_.begin);
  const Arrays arrays{now_, old_, y_, shift_, D_};
  if (measured.what == Measured::nothing) {
    local_part(rule_, arrays, begin, end);
  } else {
    local_part(rule_, arrays, begin, own_.begin);
    measured_part(measured);
    local_part(rule_, arrays, (own_.end + lanes - 1) / lanes * lanes, end);
  }
  // Ends are those of a chain that is reflected there.
  if (is_end(ends.left)) y_[own_.begin - 1] = y_[own_.begin + 1];
  if (is_end(ends.right)) y_[own_.end] = y_[own_.end - 2];
  add_neighbours(rule_, y_, old_, begin, end);
  if (ends.left == EndCondition::fixed) old_[own_.begin] = now_[own_.begin];
  if (ends.right == EndCondition::fixed) old_[own_.end - 1] = now_[own_.end - 1];
  std::swap(now_, old_);
  first_ += static_cast<std::int32_t>(now_[own_.begin] - old_[own_.begin]);
}

/// Computes the local part of the sites of the tile, and measures the step to this level.
void PhaseTile::measured_part(const StepOfU& measured) {
  const double factor = measured.what == Measured::squares ? measured.factor / (units * units) : 0;
  sums_.resize(2 * wide * measured.to.blocks);
  local_part_with_work(rule_, {now_, old_, y_, shift_, D_}, measured.to, sums_.data());
  add_sums(sums_.data(), factor, measured.to);
}

void PhaseTile::finish(double* before, double* now, const StepOfU& measured) {
  const std::size_t begin = own_.begin;
  to_turns(first_, now_ + begin, old_ + begin, before + begin, now + begin, own_.end - begin);
  not_followed_ = begin;
  if (follow(now_, old_, begin, own_.end - 1))
    not_followed_ = own_.end;
  else
    while (follow(now_, old_, not_followed_, not_followed_ + 1)) ++not_followed_;
  if (measured.what != Measured::nothing) measured_part(measured);
}

}  // namespace slipfront::chain
