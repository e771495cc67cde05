#pragma once

#include <cstddef>

#include "periodic_force.hpp"

/// The loops over sites where a chain spends its time, as vector code chosen at run time (AVX-512, AVX2 or plain).
/// Every site is computed by the same operations wherever it falls in a vector, so that tilings and threads change no
/// bits.
namespace slipfront::chain {

/// One level, z -> z at the next, in two loops:
///     S = f(z)    y = z - coupled S    next = keep z - force S - before z_old    next += spread (y_left + y_right)
struct LevelRule {
  PeriodicForce f;
  double coupled = 0, keep = 0, force = 0, before = 0, spread = 0;
};

inline constexpr std::size_t lanes = 8;  ///< ranges are multiples of it, arrays aligned to as many doubles

/// First loop over [begin, end): `next` holds the level before on entry.
void local_part(const LevelRule& rule, const double* now, double* next, double* y, std::size_t begin, std::size_t end);
/// The same where the substrate is a(x)^2 as strong: S = a2 sin u with z = u + eps S, u by Newton's method.
void local_part_with_contact(const LevelRule& rule, const PeriodicForce& sine, double eps, const double* a2,
                             const double* now, double* next, double* y, std::size_t begin, std::size_t end);
/// u and S from z; a2 may be null (1 everywhere).
void displacements(const PeriodicForce& sine, double eps, const double* a2, const double* z, double* u, double* S,
                   std::size_t size);
/// Second loop; reads y from begin - 1 to end.
void add_neighbours(double spread, const double* y, double* next, std::size_t begin, std::size_t end);

/// Whether all |z| are below what range reduction bears (false for NaN).
bool bounded(const double* z, std::size_t size);

}  // namespace slipfront::chain
