#include "lattice/chain/explicit/levels/kernel.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>

#include "math/constants.hpp"
#include "math/simd/vector_code.hpp"

namespace slipfront::chain {
namespace {

constexpr std::size_t terms = PeriodicForce::terms;

/// The number that a site adds to a sum: first + second / 12.
struct Term {
  double first = 0, second = 0;
};
struct LaneSums {
  double first[lanes] = {}, second[lanes] = {};
};

/// Calls site(j, k) for each site j of [begin, end), which are whole vectors; k is its lane. The first `count` numbers
/// of what it returns are added to `part`.
template <int count, class Site>
[[gnu::always_inline]] inline void each_vector(std::size_t begin, std::size_t end, LaneSums& part, const Site& site) {
  for (std::size_t j = begin; j < end; j += lanes) {
    SLIPFRONT_INDEPENDENT
    for (std::size_t k = 0; k < lanes; ++k) {
      const Term term = site(j + k, k);
      if constexpr (count > 0) part.first[k] += term.first;
      if constexpr (count > 1) part.second[k] += term.second;
    }
  }
}

/// Like each_vector for the vector from site j on of block i. Sites outside the block add nothing.
template <int count, class Site>
[[gnu::always_inline]] inline void odd_vector(const BlockSums& to, std::size_t i, std::size_t j, LaneSums& part,
                                              const Site& site) {
  const std::size_t first = to.begin(i), last = to.begin(i + 1) - 1;
  LaneSums odd;
  each_vector<count>(j, j + lanes, odd, site);
  for (std::size_t k = 0; k < lanes && j + k <= last; ++k) {
    const bool half =
        (to.half_first && i == 0 && j + k == first) || (to.half_last && i + 1 == to.blocks && j + k == last);
    part.first[k] += half ? odd.first[k] / 2 : odd.first[k];
    part.second[k] += half ? odd.second[k] / 2 : odd.second[k];
  }
}

/// Calls site(j, k) for each site of [begin, end), whole vectors. The sums of blocks get `factor` times what it
/// returns.
template <int count, class Site>
[[gnu::always_inline]] inline void each_sum(const BlockSums& to, double factor, std::size_t begin, std::size_t end,
                                            const Site& site) {
  LaneSums unused;
  each_vector<0>(begin, to.at, unused, site);
  std::size_t j = to.at;
  for (std::size_t i = 0; i < to.blocks; ++i) {
    const std::size_t until = to.begin(i + 1), whole = until / lanes * lanes;
    LaneSums part;
    if (to.half_first && i == 0) {
      odd_vector<count>(to, i, j, part, site);
      j += lanes;
    }
    const bool odd = whole < until || (to.half_last && i + 1 == to.blocks);
    const std::size_t even = std::max(j, whole < until || !odd ? whole : whole - lanes);
    each_vector<count>(j, even, part, site);
    j = even;
    if (j < until) {
      odd_vector<count>(to, i, j, part, site);
      j += lanes;
    }
    double* const sums = to.sums + i * to.stride;
    for (std::size_t k = 0; k < lanes; ++k) {
      if constexpr (count > 1) part.first[k] += part.second[k] * (1.0 / 12);
      part.first[k] = sums[k] + factor * part.first[k];
    }
    std::memcpy(sums, part.first, sizeof part.first);
  }
  each_vector<0>(j, end, unused, site);
}

/// Keeps u at site j and the step to it, and returns the measure of the step.
template <Measured what>
[[gnu::always_inline]] inline Term keep(const StepOfU& step, double u, std::size_t j) {
  if constexpr (what == Measured::nothing) return {};
  const double D = u - step.u[j], B = D - step.D_before[j];
  step.u[j] = u;
  if constexpr (what != Measured::only_absolutes && what != Measured::only_cubes) step.D[j] = D;
  if constexpr (what == Measured::squares) return {D * D, B * B};
  if constexpr (what == Measured::only_cubes) return {std::fabs(D) * (D * D)};
  return {std::fabs(D)};
}

template <Measured what, class Site>
[[gnu::always_inline]] inline void each_site(const StepOfU& step, std::size_t begin, std::size_t end,
                                             const Site& site) {
  LaneSums unused;
  if constexpr (what == Measured::nothing || what == Measured::steps)
    each_vector<0>(begin, end, unused, site);
  else
    each_sum<what == Measured::squares ? 2 : 1>(step.to, step.factor, begin, end, site);
}

/// S at lane j of a vector with these coefficients.
[[gnu::always_inline]] inline double force_of_contact(const double* c, double z, std::size_t j) {
  const double rest = part_of_turn(z), square = rest * rest;
  double p = c[(terms - 1) * lanes + j];
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC unroll 16
#endif
  for (std::size_t k = terms - 1; k-- > 0;) p = p * square + c[k * lanes + j];
  return rest * p;
}

/// S at site j, lane k of its vector, of a substrate of strength 1, or with coefficients site by site.
struct EqualForce {
  PeriodicForce f;
  [[gnu::always_inline]] double operator()(double z, std::size_t, std::size_t) const { return f(z); }
};
struct ForceOfCoefficients {
  const double* coefficients;
  [[gnu::always_inline]] double operator()(double z, std::size_t j, std::size_t k) const {
    return force_of_contact(coefficients + terms * (j - k), z, k);
  }
};

// Eq. (3): u_tt - u_xx + sin u = F - f. In z = u + eps sin u it is a rule of five points, with S = sin u as f(z):
//     next = (keep z - force S - before z_old) + spread (y_left + y_right),    y = z - coupled S
// The second sum is add_neighbours, and the load and other friction follow.
template <class Force>
struct FirstLoop {
  LevelRule rule;  // copies: the stores cannot change them
  Force force;
  const double *now, *old;
  double *next, *y;
  std::size_t begin, end;
  StepOfU step;

  template <Measured what>
  [[gnu::always_inline]] void measuring() const {
    const FirstLoop l = *this;
    each_site<what>(
        l.step, l.begin, l.end, [&l](std::size_t j, std::size_t k) __attribute__((always_inline)) {
          const double z = l.now[j], S = l.force(z, j, k);
          l.y[j] = z - l.rule.coupled * S;
          l.next[j] = (l.rule.keep * z - l.rule.force * S) - l.rule.before * l.old[j];
          return keep<what>(l.step, z - l.step.eps * S, j);
        });
  }
};

/// Calls loop.measuring<what>().
template <class Loop>
[[gnu::always_inline]] inline void as_measured(Measured what, const Loop& loop) {
  if (what == Measured::nothing) return loop.template measuring<Measured::nothing>();
  if (what == Measured::steps) return loop.template measuring<Measured::steps>();
  if (what == Measured::only_absolutes) return loop.template measuring<Measured::only_absolutes>();
  if (what == Measured::absolutes) return loop.template measuring<Measured::absolutes>();
  if (what == Measured::only_cubes) return loop.template measuring<Measured::only_cubes>();
  loop.template measuring<Measured::squares>();
}

}  // namespace

SLIPFRONT_CLONES void local_part(const LevelRule& rule, const double* now, const double* old, double* next, double* y,
                                 std::size_t begin, std::size_t end, const StepOfU& step) {
  as_measured(step.what, FirstLoop<EqualForce>{rule, {rule.f}, now, old, next, y, begin, end, step});
}

SLIPFRONT_CLONES void local_part_with_coefficients(const LevelRule& rule, const double* coefficients, const double* now,
                                                   const double* old, double* next, double* y, std::size_t begin,
                                                   std::size_t end, const StepOfU& step) {
  as_measured(step.what, FirstLoop<ForceOfCoefficients>{rule, {coefficients}, now, old, next, y, begin, end, step});
}

namespace {

/// u from z = u + strength sin(2 pi u) / 2 pi; strength < 0.1, so that two steps reach rounding.
inline double displacement(const PeriodicForce& sine, double strength, double z) {
  double u = z - strength * sine(z);
  for (int i = 0; i < 2; ++i) {
    const double slope = 1 + strength * turn * sine(u + 0.25);
    u -= (u + strength * sine(u) - z) / slope;
  }
  return u;
}

}  // namespace

SLIPFRONT_CLONES void contact_coefficients(const ContactForce& force, const double* a2, double* coefficients,
                                           std::size_t begin, std::size_t end) {
  const ContactForce f = force;
  for (std::size_t first = begin; first < end; first += lanes) {
    double* const of_vector = coefficients + terms * first;
    SLIPFRONT_INDEPENDENT
    for (std::size_t j = 0; j < lanes; ++j) {
      const double strength = a2[first + j];
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC unroll 16
#endif
      for (std::size_t k = 0; k < terms; ++k)
        of_vector[k * lanes + j] = strength * f.coefficient(static_cast<int>(k), strength);
    }
  }
}

SLIPFRONT_CLONES void displacements(const PeriodicForce& sine, double eps, const double* a2, const double* z, double* u,
                                    double* S, std::size_t size) {
  const PeriodicForce f = sine;
  if (a2 == nullptr) {  // its own loop: vector code would load from null, which is slow though its result is not used
    SLIPFRONT_INDEPENDENT
    for (std::size_t j = 0; j < size; ++j) {
      u[j] = displacement(f, eps, z[j]);
      S[j] = f(u[j]);
    }
    return;
  }
  SLIPFRONT_INDEPENDENT
  for (std::size_t j = 0; j < size; ++j) {
    u[j] = displacement(f, eps * a2[j], z[j]);
    S[j] = a2[j] * f(u[j]);
  }
}

SLIPFRONT_CLONES void displacements(const PeriodicForce& force, double eps, const double* coefficients, const double* z,
                                    double* u, std::size_t begin, std::size_t end) {
  const PeriodicForce f = force;
  if (coefficients == nullptr) {
    SLIPFRONT_INDEPENDENT
    for (std::size_t j = begin; j < end; ++j) u[j] = z[j] - eps * f(z[j]);
    return;
  }
  for (std::size_t first = begin; first < end; first += lanes) {
    const double* const c = coefficients + terms * first;
    SLIPFRONT_INDEPENDENT
    for (std::size_t j = 0; j < lanes; ++j) u[first + j] = z[first + j] - eps * force_of_contact(c, z[first + j], j);
  }
}

namespace {

/// The end of a step from `now` to `next` after Coulomb friction.
[[gnu::always_inline]] inline double shortened(double most, double now, double next) {
  const double step = next - now, stopped = step < -most ? -most : step > most ? most : step;
  return now + (step - stopped);
}

}  // namespace

SLIPFRONT_CLONES void add_neighbours(double spread, const double* y, double* next, std::size_t begin, std::size_t end) {
  const std::size_t n = (end - begin) / lanes * lanes;
  const double *left = y + begin - 1, *right = y + begin + 1;
  next += begin;
  SLIPFRONT_INDEPENDENT
  for (std::size_t j = 0; j < n; ++j) next[j] += spread * (left[j] + right[j]);
}

SLIPFRONT_CLONES void add_neighbours_and_shorten(double spread, double most, const double* y, const double* now,
                                                 double* next, std::size_t begin, std::size_t end) {
  const std::size_t n = (end - begin) / lanes * lanes;
  const double *left = y + begin - 1, *right = y + begin + 1;
  now += begin;
  next += begin;
  SLIPFRONT_INDEPENDENT
  for (std::size_t j = 0; j < n; ++j) next[j] = shortened(most, now[j], next[j] + spread * (left[j] + right[j]));
}

namespace {

constexpr std::size_t terms_at_once = 4;

/// Calls loop.of<n>(first) for all terms, n of them at once from `first` on.
template <class Loop>
[[gnu::always_inline]] inline void each_term(const ForceTerms& F, const Loop& loop) {
  std::size_t first = 0;
  for (; first + terms_at_once <= F.count; first += terms_at_once) loop.template of<terms_at_once>(first);
  if (F.count - first == 1) loop.template of<1>(first);
  if (F.count - first == 2) loop.template of<2>(first);
  if (F.count - first == 3) loop.template of<3>(first);
}

struct AddDrive {
  const ForceTerms& F;
  const ForceTerms::Weights &own, &of_neighbours;
  double* next;
  std::size_t size;

  template <std::size_t n>
  [[gnu::always_inline]] void of(std::size_t first) const {
    const double* left[n];  // X at the neighbour to the left
    double c[n], b[n];
    for (std::size_t s = 0; s < n; ++s) {
      left[s] = F.X[first + s] - 1;
      c[s] = own[first + s];
      b[s] = of_neighbours[first + s];
    }
    SLIPFRONT_INDEPENDENT
    for (std::size_t j = 0; j < size; ++j) {
      double sum = next[j];
      for (std::size_t s = 0; s < n; ++s) sum += c[s] * left[s][j + 1] + b[s] * (left[s][j] + left[s][j + 2]);
      next[j] = sum;
    }
  }
};

}  // namespace

SLIPFRONT_CLONES void add_drive(const ForceTerms& F, const ForceTerms::Weights& own,
                                const ForceTerms::Weights& of_neighbours, double* next, std::size_t size) {
  each_term(F, AddDrive{F, own, of_neighbours, next, size});
}

SLIPFRONT_CLONES void add_steady_drive(const double* drive, double* next, std::size_t size) {
  SLIPFRONT_INDEPENDENT
  for (std::size_t j = 0; j < size; ++j) next[j] += drive[j];
}

SLIPFRONT_CLONES void shorten_steps(double most, const double* now, double* next, std::size_t size) {
  SLIPFRONT_INDEPENDENT
  for (std::size_t j = 0; j < size; ++j) next[j] = shortened(most, now[j], next[j]);
}

SLIPFRONT_CLONES void velocities(double per_step, const double* now, const double* next, double* velocity,
                                 std::size_t size) {
  SLIPFRONT_INDEPENDENT
  for (std::size_t j = 0; j < size; ++j) velocity[j] = (next[j] - now[j]) * per_step;
}

namespace {

/// Adds of_site(j) of each site of the blocks, counted from the first.
template <class OfSite>
[[gnu::always_inline]] inline void add_terms(BlockSums to, double factor, const OfSite& of_site) {
  to.at = 0;
  each_sum<1>(
      to, factor, 0, 0, [&](std::size_t j, std::size_t) __attribute__((always_inline)) { return Term{of_site(j)}; });
}

}  // namespace

SLIPFRONT_CLONES void add_values(const BlockSums& to, double factor, const double* a) {
  add_terms(to, factor, [=](std::size_t j) { return a[j]; });
}

SLIPFRONT_CLONES void add_products(const BlockSums& to, double factor, const double* a, const double* b) {
  add_terms(to, factor, [=](std::size_t j) { return a[j] * b[j]; });
}

namespace {

struct AddWorks {
  const BlockSums& to;
  double factor;
  const ForceTerms& F;
  const ForceTerms::Weights &of_D, &of_B;
  const double *D, *D_before;

  template <std::size_t n>
  [[gnu::always_inline]] void of(std::size_t first) const {
    const double* X[n];
    double c[n], b[n];
    for (std::size_t s = 0; s < n; ++s) {
      X[s] = F.X[first + s];
      c[s] = of_D[first + s];
      b[s] = of_B[first + s];
    }
    const double *const step = D, *const before = D_before;
    add_terms(
        to, factor, [=](std::size_t j) __attribute__((always_inline)) {
          const double B = step[j] - before[j];
          double work = 0;
          for (std::size_t s = 0; s < n; ++s) work += X[s][j] * (c[s] * step[j] + b[s] * B);
          return work;
        });
  }
};

}  // namespace

SLIPFRONT_CLONES void add_works(const BlockSums& to, double factor, const ForceTerms& F,
                                const ForceTerms::Weights& of_D, const ForceTerms::Weights& of_B, const double* D,
                                const double* D_before) {
  each_term(F, AddWorks{to, factor, F, of_D, of_B, D, D_before});
}

SLIPFRONT_CLONES void energies_of_contacts(const PeriodicForce& sine, const double* a2, const double* a2_next,
                                           const double* u, const double* D, double* energy, std::size_t size) {
  const PeriodicForce f = sine;
  SLIPFRONT_INDEPENDENT
  for (std::size_t j = 0; j < size; ++j) {
    const double cosines = f(u[j] + 0.25) + f(u[j] - D[j] + 0.25);  // over 2 pi
    energy[j] = (a2_next[j] - a2[j]) * (1 - turn / 2 * cosines);
  }
}

SLIPFRONT_CLONES bool bounded(const double* z, std::size_t size, double most) {
  std::size_t bad = 0;
  for (std::size_t j = 0; j < size; ++j) bad += std::fabs(z[j]) < most ? 0u : 1u;
  return bad == 0;
}

}  // namespace slipfront::chain
