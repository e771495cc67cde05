#include "chain/explicit/levels/kernel.hpp"

#include <cmath>

#include "foundation/math/constants.hpp"
#include "foundation/simd/vector_code.hpp"

namespace slipfront::chain {
namespace {

constexpr std::size_t terms = PeriodicForce::terms;

}  // namespace

// Eq. (3): u_tt - u_xx + sin u = F - f. In z = u + eps sin u it is a rule of five points, with S = sin u as f(z):
//     next = (keep z - force S - before z_old) + spread (y_left + y_right),    y = z - coupled S
// The second sum is add_neighbours, and the load and other friction follow.
SLIPFRONT_CLONES void local_part(const LevelRule& rule, const double* now, const double* old, double* next, double* y,
                                 std::size_t begin, std::size_t end) {
  const LevelRule r = rule;  // a copy: the stores cannot change it
  const std::size_t n = (end - begin) / lanes * lanes;
  now += begin;
  old += begin;
  next += begin;
  y += begin;
  SLIPFRONT_INDEPENDENT
  for (std::size_t j = 0; j < n; ++j) {
    const double z = now[j], S = r.f(z);
    y[j] = z - r.coupled * S;
    next[j] = (r.keep * z - r.force * S) - r.before * old[j];
  }
}

namespace {

/// S for a substrate of strength a2 (ContactForce).
[[gnu::always_inline]] inline double force_of_contact(const ContactForce& f, double a2, double z) {
  const double r = part_of_turn(z), square = r * r;
  double p = f.coefficient(PeriodicForce::terms - 1, a2);
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC unroll 16
#endif
  for (int k = PeriodicForce::terms - 2; k >= 0; --k) p = p * square + f.coefficient(k, a2);
  return a2 * (r * p);
}

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

SLIPFRONT_CLONES void local_part_with_contact(const LevelRule& rule, const ContactForce& force, const double* a2,
                                              const double* now, const double* old, double* next, double* y,
                                              std::size_t begin, std::size_t end) {
  const LevelRule r = rule;
  const ContactForce f = force;
  SLIPFRONT_INDEPENDENT
  for (std::size_t j = begin; j < end; ++j) {
    const double z = now[j], S = force_of_contact(f, a2[j], z);
    y[j] = z - r.coupled * S;
    next[j] = (r.keep * z - r.force * S) - r.before * old[j];
  }
}

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
                                                   std::size_t end) {
  const LevelRule r = rule;
  for (std::size_t first = begin; first < end; first += lanes) {
    const double* const c = coefficients + terms * first;
    SLIPFRONT_INDEPENDENT
    for (std::size_t j = 0; j < lanes; ++j) {
      const double z = now[first + j], rest = part_of_turn(z), square = rest * rest;
      double p = c[(terms - 1) * lanes + j];
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC unroll 16
#endif
      for (std::size_t k = terms - 1; k-- > 0;) p = p * square + c[k * lanes + j];
      const double S = rest * p;
      y[first + j] = z - r.coupled * S;
      next[first + j] = (r.keep * z - r.force * S) - r.before * old[first + j];
    }
  }
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

SLIPFRONT_CLONES void displacements(const PeriodicForce& force, double eps, const double* z, double* u,
                                    std::size_t size) {
  const PeriodicForce f = force;
  SLIPFRONT_INDEPENDENT
  for (std::size_t j = 0; j < size; ++j) u[j] = z[j] - eps * f(z[j]);
}

SLIPFRONT_CLONES void displacements(const ContactForce& force, double eps, const double* a2, const double* z, double* u,
                                    std::size_t size) {
  const ContactForce f = force;
  SLIPFRONT_INDEPENDENT
  for (std::size_t j = 0; j < size; ++j) u[j] = z[j] - eps * force_of_contact(f, a2[j], z[j]);
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

SLIPFRONT_CLONES void take_steps(const ContactForce& force, double eps, const double* a2_next, const double* before,
                                 const double* now, const double* next, double* u, double* D, double* B,
                                 std::size_t size) {
  const ContactForce f = force;
  SLIPFRONT_INDEPENDENT
  for (std::size_t j = 0; j < size; ++j) {
    const double z = next[j], u_next = z - eps * force_of_contact(f, a2_next[j], z);
    D[j] = turn * (u_next - u[j]);
    B[j] = turn * ((z - now[j]) - (now[j] - before[j]));
    u[j] = u_next;
  }
}

SLIPFRONT_CLONES void take_steps(const PeriodicForce& force, double eps, const double* before, const double* now,
                                 const double* next, double* u, double* D, double* B, std::size_t size) {
  const PeriodicForce f = force;
  SLIPFRONT_INDEPENDENT
  for (std::size_t j = 0; j < size; ++j) {
    const double z = next[j], u_next = z - eps * f(z);
    D[j] = turn * (u_next - u[j]);
    B[j] = turn * ((z - now[j]) - (now[j] - before[j]));
    u[j] = u_next;
  }
}

namespace {

inline double total(const double (&part)[lanes]) {
  return ((part[0] + part[4]) + (part[2] + part[6])) + ((part[1] + part[5]) + (part[3] + part[7]));
}

}  // namespace

SLIPFRONT_CLONES double work_of_force(const double* F_before, const double* F_now, const double* F_next,
                                      const double* D, const double* B, std::size_t size) {
  double part[lanes] = {};
  const std::size_t whole = size / lanes * lanes;
  const auto work = [=](std::size_t j) {
    return (F_now[j] + F_next[j]) * 0.5 * D[j] + (F_next[j] - F_before[j]) * B[j] * (1.0 / 12);
  };
  for (std::size_t j = 0; j < whole; j += lanes)
    for (std::size_t k = 0; k < lanes; ++k) part[k] += work(j + k);
  for (std::size_t k = 0; k < size - whole; ++k) part[k] += work(whole + k);
  return total(part);
}

SLIPFRONT_CLONES double sum_of_products(const double* a, const double* b, std::size_t size) {
  double part[lanes] = {};
  const std::size_t whole = size / lanes * lanes;
  for (std::size_t j = 0; j < whole; j += lanes)
    for (std::size_t k = 0; k < lanes; ++k) part[k] += a[j + k] * b[j + k];
  for (std::size_t k = 0; k < size - whole; ++k) part[k] += a[whole + k] * b[whole + k];
  return total(part);
}

SLIPFRONT_CLONES double work_of_viscous_friction(const double* D, const double* B, std::size_t size) {
  double part[lanes] = {};
  const std::size_t whole = size / lanes * lanes;
  for (std::size_t j = 0; j < whole; j += lanes)
    for (std::size_t k = 0; k < lanes; ++k) part[k] += D[j + k] * D[j + k] + B[j + k] * B[j + k] * (1.0 / 12);
  for (std::size_t k = 0; k < size - whole; ++k)
    part[k] += D[whole + k] * D[whole + k] + B[whole + k] * B[whole + k] * (1.0 / 12);
  return total(part);
}

SLIPFRONT_CLONES double energy_of_contacts(const PeriodicForce& sine, const double* a2, const double* a2_next,
                                           const double* u, const double* D, std::size_t size) {
  const PeriodicForce f = sine;
  double part[lanes] = {};
  const std::size_t whole = size / lanes * lanes;
  const auto energy = [=](std::size_t j) {
    const double cosines = f(u[j] + 0.25) + f(u[j] - D[j] * (1 / turn) + 0.25);  // over 2 pi
    return (a2_next[j] - a2[j]) * (1 - turn / 2 * cosines);
  };
  for (std::size_t j = 0; j < whole; j += lanes)
    for (std::size_t k = 0; k < lanes; ++k) part[k] += energy(j + k);
  for (std::size_t k = 0; k < size - whole; ++k) part[k] += energy(whole + k);
  return total(part);
}

SLIPFRONT_CLONES double work_of_coulomb_friction(const double* D, std::size_t size) {
  double part[lanes] = {};
  const std::size_t whole = size / lanes * lanes;
  for (std::size_t j = 0; j < whole; j += lanes)
    for (std::size_t k = 0; k < lanes; ++k) part[k] += std::fabs(D[j + k]);
  for (std::size_t k = 0; k < size - whole; ++k) part[k] += std::fabs(D[whole + k]);
  return total(part);
}

SLIPFRONT_CLONES bool bounded(const double* z, std::size_t size) {
  std::size_t bad = 0;
  for (std::size_t j = 0; j < size; ++j) bad += std::fabs(z[j]) < 2251799813685248.0 ? 0u : 1u;
  return bad == 0;
}

}  // namespace slipfront::chain
