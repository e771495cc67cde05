#include "kernel.hpp"

#include <cmath>

#include "../vector_code.hpp"

namespace slipfront::chain {

SLIPFRONT_CLONES void local_part(const LevelRule& rule, const double* now, double* next, double* y, std::size_t begin,
                                 std::size_t end) {
  const LevelRule r = rule;  // a copy: the stores cannot change it
  const std::size_t n = (end - begin) / lanes * lanes;
  now += begin;
  next += begin;
  y += begin;
  SLIPFRONT_INDEPENDENT
  for (std::size_t j = 0; j < n; ++j) {
    const double z = now[j], S = r.f(z);
    y[j] = z - r.coupled * S;
    next[j] = (r.keep * z - r.force * S) - r.before * next[j];
  }
}

namespace {

/// u from z = u + strength sin(2 pi u) / 2 pi; strength < 0.1, so that two steps reach rounding.
inline double displacement(const PeriodicForce& sine, double strength, double z) {
  double u = z - strength * sine(z);
  for (int i = 0; i < 2; ++i) {
    const double slope = 1 + strength * 6.283185307179586 * sine(u + 0.25);
    u -= (u + strength * sine(u) - z) / slope;
  }
  return u;
}

}  // namespace

SLIPFRONT_CLONES void local_part_with_contact(const LevelRule& rule, const PeriodicForce& sine, double eps,
                                              const double* a2, const double* now, double* next, double* y,
                                              std::size_t begin, std::size_t end) {
  const LevelRule r = rule;
  const PeriodicForce f = sine;
  SLIPFRONT_INDEPENDENT
  for (std::size_t j = begin; j < end; ++j) {
    const double z = now[j], S = a2[j] * f(displacement(f, eps * a2[j], z));
    y[j] = z - r.coupled * S;
    next[j] = (r.keep * z - r.force * S) - r.before * next[j];
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

SLIPFRONT_CLONES void add_neighbours(double spread, const double* y, double* next, std::size_t begin, std::size_t end) {
  const std::size_t n = (end - begin) / lanes * lanes;
  const double *left = y + begin - 1, *right = y + begin + 1;
  next += begin;
  SLIPFRONT_INDEPENDENT
  for (std::size_t j = 0; j < n; ++j) next[j] += spread * (left[j] + right[j]);
}

SLIPFRONT_CLONES bool bounded(const double* z, std::size_t size) {
  std::size_t bad = 0;
  for (std::size_t j = 0; j < size; ++j) bad += std::fabs(z[j]) < 2251799813685248.0 ? 0u : 1u;
  return bad == 0;
}

}  // namespace slipfront::chain
