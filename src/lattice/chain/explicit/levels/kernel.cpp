#include "lattice/chain/explicit/levels/kernel.hpp"

#include <cmath>

#include "math/constants.hpp"
#include "math/simd/vector_code.hpp"

namespace slipfront::chain {
namespace {

constexpr std::size_t terms = PeriodicForce::terms;

/// Takes the step to z - eps S at site j.
template <bool steps>
[[gnu::always_inline]] inline void take_step(const StepOfU& step, double z, double S, std::size_t j) {
  if constexpr (steps) {
    const double u = z - step.eps * S;
    step.D[j] = turn * (u - step.u[j]);
    step.u[j] = u;
  }
}

// Eq. (3): u_tt - u_xx + sin u = F - f. In z = u + eps sin u it is a rule of five points, with S = sin u as f(z):
//     next = (keep z - force S - before z_old) + spread (y_left + y_right),    y = z - coupled S
// The second sum is add_neighbours, and the load and other friction follow.
template <bool steps>
[[gnu::always_inline]] inline void local_loop(const LevelRule& r, const double* now, const double* old, double* next,
                                              double* y, std::size_t n, const StepOfU& step) {
  SLIPFRONT_INDEPENDENT
  for (std::size_t j = 0; j < n; ++j) {
    const double z = now[j], S = r.f(z);
    y[j] = z - r.coupled * S;
    next[j] = (r.keep * z - r.force * S) - r.before * old[j];
    take_step<steps>(step, z, S, j);
  }
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

template <bool steps>
[[gnu::always_inline]] inline void local_loop_with_coefficients(const LevelRule& r, const double* coefficients,
                                                                const double* now, const double* old, double* next,
                                                                double* y, std::size_t begin, std::size_t end,
                                                                const StepOfU& step) {
  for (std::size_t first = begin; first < end; first += lanes) {
    const double* const c = coefficients + terms * first;
    SLIPFRONT_INDEPENDENT
    for (std::size_t j = 0; j < lanes; ++j) {
      const double z = now[first + j], S = force_of_contact(c, z, j);
      y[first + j] = z - r.coupled * S;
      next[first + j] = (r.keep * z - r.force * S) - r.before * old[first + j];
      take_step<steps>(step, z, S, first + j);
    }
  }
}

}  // namespace

SLIPFRONT_CLONES void local_part(const LevelRule& rule, const double* now, const double* old, double* next, double* y,
                                 std::size_t begin, std::size_t end, const StepOfU& step) {
  const LevelRule r = rule;  // a copy: the stores cannot change it
  const std::size_t n = (end - begin) / lanes * lanes;
  if (step.u == nullptr)
    local_loop<false>(r, now + begin, old + begin, next + begin, y + begin, n, {});
  else
    local_loop<true>(r, now + begin, old + begin, next + begin, y + begin, n,
                     {step.eps, step.u + begin, step.D + begin});
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

SLIPFRONT_CLONES void local_part_with_coefficients(const LevelRule& rule, const double* coefficients, const double* now,
                                                   const double* old, double* next, double* y, std::size_t begin,
                                                   std::size_t end, const StepOfU& step) {
  const LevelRule r = rule;
  if (step.u == nullptr)
    local_loop_with_coefficients<false>(r, coefficients, now, old, next, y, begin, end, {});
  else
    local_loop_with_coefficients<true>(r, coefficients, now, old, next, y, begin, end, StepOfU(step));
}

SLIPFRONT_CLONES void displacements(const PeriodicForce& sine, double eps, const double* a2, const double* z, double* u,
                                    double* S, std::size_t size) {
  const PeriodicForce f = sine;
  SLIPFRONT_INDEPENDENT
  for (std::size_t j = 0; j < size; ++j) {
    const double a = a2 != nullptr ? a2[j] : 1.0;
    u[j] = displacement(f, eps * a, z[j]);
    S[j] = a * f(u[j]);
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

SLIPFRONT_CLONES void keep_differences(const double* u_next, double* u, double* D, std::size_t size) {
  SLIPFRONT_INDEPENDENT
  for (std::size_t j = 0; j < size; ++j) {
    D[j] = turn * (u_next[j] - u[j]);
    u[j] = u_next[j];
  }
}

SLIPFRONT_CLONES void second_differences(const double* before, const double* now, const double* next, double* B,
                                         std::size_t size) {
  SLIPFRONT_INDEPENDENT
  for (std::size_t j = 0; j < size; ++j) B[j] = turn * ((next[j] - now[j]) - (now[j] - before[j]));
}

SLIPFRONT_CLONES void add_neighbours(double spread, const double* y, double* next, std::size_t begin, std::size_t end) {
  const std::size_t n = (end - begin) / lanes * lanes;
  const double *left = y + begin - 1, *right = y + begin + 1;
  next += begin;
  SLIPFRONT_INDEPENDENT
  for (std::size_t j = 0; j < n; ++j) next[j] += spread * (left[j] + right[j]);
}

SLIPFRONT_CLONES void add_drive(const DriveRule& rule, const double* F_before, const double* F_now,
                                const double* F_next, double* next, std::size_t size) {
  const DriveRule r = rule;
  const double *left = F_now - 1, *right = F_now + 1;
  SLIPFRONT_INDEPENDENT
  for (std::size_t j = 0; j < size; ++j)
    next[j] += r.next * F_next[j] + r.before * F_before[j] + r.now * F_now[j] + r.neighbour * (left[j] + right[j]);
}

SLIPFRONT_CLONES void add_steady_drive(const double* drive, double* next, std::size_t size) {
  SLIPFRONT_INDEPENDENT
  for (std::size_t j = 0; j < size; ++j) next[j] += drive[j];
}

SLIPFRONT_CLONES void shorten_steps(double most, const double* now, double* next, std::size_t size) {
  SLIPFRONT_INDEPENDENT
  for (std::size_t j = 0; j < size; ++j) {
    const double step = next[j] - now[j], rest = std::fabs(step) - most;
    next[j] = now[j] + std::copysign(rest <= 0 ? 0.0 : rest, step);
  }
}

SLIPFRONT_CLONES bool free_speeds(double per_step, const double* from, const double* next, double* free,
                                  std::size_t size) {
  std::size_t moving = 0;
  SLIPFRONT_INDEPENDENT
  for (std::size_t j = 0; j < size; ++j) {
    const double step = std::fabs(next[j] - from[j]), scale = std::fabs(from[j]);
    free[j] = step <= 8 * 2.2e-16 * (scale > 1e-3 ? scale : 1e-3) ? 0.0 : step * per_step;
    moving += free[j] == 0 ? 0u : 1u;
  }
  return moving != 0;
}

SLIPFRONT_CLONES void take_speeds(double per_step, double per_weight, const double* from, const double* free,
                                  const double* speed, double* next, double* force, std::size_t size) {
  const double step_per_speed = 1 / per_step;
  if (force != nullptr) {
    SLIPFRONT_INDEPENDENT
    for (std::size_t j = 0; j < size; ++j) {
      const double step = next[j] - from[j];
      force[j] = std::copysign((free[j] - speed[j]) * per_weight, step);
      next[j] = from[j] + (std::copysign(speed[j] * step_per_speed, step) + 0 * step);
    }
    return;
  }
  SLIPFRONT_INDEPENDENT
  for (std::size_t j = 0; j < size; ++j) {
    const double step = next[j] - from[j];
    next[j] = from[j] + (std::copysign(speed[j] * step_per_speed, step) + 0 * step);
  }
}

SLIPFRONT_CLONES void velocities(double per_step, const double* now, const double* next, double* velocity,
                                 std::size_t size) {
  SLIPFRONT_INDEPENDENT
  for (std::size_t j = 0; j < size; ++j) velocity[j] = (next[j] - now[j]) * per_step;
}

SLIPFRONT_CLONES void speeds(double per_step, const double* D, double* speed, std::size_t size) {
  SLIPFRONT_INDEPENDENT
  for (std::size_t j = 0; j < size; ++j) speed[j] = std::fabs(D[j]) * per_step;
}

namespace {

/// term(j) of each site, in the sums of the blocks.
template <class Term>
[[gnu::always_inline]] inline void add_terms(const BlockSums& to, const Term& term) {
  for (std::size_t i = 0; i < to.blocks; ++i) {
    double* const sums = to.sums + i * to.stride;
    double part[lanes];
    for (std::size_t k = 0; k < lanes; ++k) part[k] = sums[k];
    const std::size_t begin = to.begins[i] - to.begins[0], end = to.begins[i + 1] - to.begins[0];
    const std::size_t whole = begin + (end - begin) / lanes * lanes;
    for (std::size_t j = begin; j < whole; j += lanes)
      for (std::size_t k = 0; k < lanes; ++k) part[k] += term(j + k);
    for (std::size_t k = 0; k < end - whole; ++k) part[k] += term(whole + k);
    for (std::size_t k = 0; k < lanes; ++k) sums[k] = part[k];
  }
}

}  // namespace

SLIPFRONT_CLONES void add_products(const BlockSums& to, double factor, const double* a, const double* b) {
  add_terms(to, [=](std::size_t j) { return factor * a[j] * b[j]; });
}

SLIPFRONT_CLONES void add_values(const BlockSums& to, double factor, const double* a) {
  add_terms(to, [=](std::size_t j) { return factor * a[j]; });
}

SLIPFRONT_CLONES void add_squares(const BlockSums& to, double factor, const double* D, const double* D_before) {
  add_terms(to, [=](std::size_t j) {
    const double B = D[j] - D_before[j];
    return factor * (D[j] * D[j] + B * B * (1.0 / 12));
  });
}

SLIPFRONT_CLONES void add_absolutes(const BlockSums& to, double factor, const double* a) {
  add_terms(to, [=](std::size_t j) { return factor * std::fabs(a[j]); });
}

SLIPFRONT_CLONES void works_of_force(const double* F_before, const double* F_now, const double* F_next, const double* D,
                                     const double* B, double* work, std::size_t size) {
  SLIPFRONT_INDEPENDENT
  for (std::size_t j = 0; j < size; ++j)
    work[j] = (F_now[j] + F_next[j]) * 0.5 * D[j] + (F_next[j] - F_before[j]) * B[j] * (1.0 / 12);
}

SLIPFRONT_CLONES void energies_of_contacts(const PeriodicForce& sine, const double* a2, const double* a2_next,
                                           const double* u, const double* D, double* energy, std::size_t size) {
  const PeriodicForce f = sine;
  SLIPFRONT_INDEPENDENT
  for (std::size_t j = 0; j < size; ++j) {
    const double cosines = f(u[j] + 0.25) + f(u[j] - D[j] * (1 / turn) + 0.25);  // over 2 pi
    energy[j] = (a2_next[j] - a2[j]) * (1 - turn / 2 * cosines);
  }
}

SLIPFRONT_CLONES void weighted_sum(const std::array<double, 8>& weights, const std::array<const double*, 8>& values,
                                   double* sum, std::size_t size) {
  const auto w = weights;
  const auto v = values;
  SLIPFRONT_INDEPENDENT
  for (std::size_t j = 0; j < size; ++j)
    sum[j] = ((w[0] * v[0][j] + w[1] * v[1][j]) + (w[2] * v[2][j] + w[3] * v[3][j])) +
             ((w[4] * v[4][j] + w[5] * v[5][j]) + (w[6] * v[6][j] + w[7] * v[7][j]));
}

SLIPFRONT_CLONES bool bounded(const double* z, std::size_t size) {
  std::size_t bad = 0;
  for (std::size_t j = 0; j < size; ++j) bad += std::fabs(z[j]) < 2251799813685248.0 ? 0u : 1u;
  return bad == 0;
}

}  // namespace slipfront::chain
