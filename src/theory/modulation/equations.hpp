#pragma once
/// \file
/// The modulation equations with friction, written for one dislocation of a train (docs/theory/3_modulation.md 3.4).
/// The coordinate q counts dislocations, l is their spacing, M = 2 pi P / k the momentum of one of them:
///     l_t = U_q,    M_t + p_q = 2 pi (F - <f>) - l <1 - cos u> (a^2)_x,
/// with U = tanh phi and p = 2 sinh^2 psi. The solver of the pulse, the Riemann solver, the tests and the benchmarks
/// all take their fluxes and sources from this file. The functions have no branches and no calls, so that loops over
/// them become vector code; they hold for |phi| < 350 and |psi| < 350.

#include <cmath>
#include <numbers>

#include "math/simd/elementary.hpp"

namespace slipfront::modulation {

/// Flux of the spacing l, the velocity of the dislocations, and flux of the momentum M, the pressure by which they
/// repel each other. One division serves both.
struct Fluxes {
  double velocity, pressure;
};
inline Fluxes fluxes(double phi, double psi) {  // Eq. (7): l_t = U_q, M_t + p_q = ..., U = tanh phi, p = 2 sinh^2 psi
  const double down = expm1_branch_free(-2 * std::fabs(phi)), up = expm1_branch_free(2 * psi);
  const double wide = 2 + down, tall = 1 + up, inverse = 1 / (wide * tall);
  return {std::copysign(down * tall * inverse, phi), (up * inverse) * wide * (up / 2)};
}
inline double velocity(double phi) { return fluxes(phi, 0).velocity; }
inline double pressure(double psi) { return fluxes(0, psi).pressure; }

/// The pressure from e^(2 psi) - 1, which keeps its digits where psi is small.
inline double pressure_from(double e_2psi_minus_1) {
  return e_2psi_minus_1 / (1 + e_2psi_minus_1) * (e_2psi_minus_1 / 2);
}

/// Source of the momentum M by a force per unit length, the load F or the mean friction <f>: in u, a dislocation is a
/// step of 2 pi.
inline double force_per_dislocation(double force) {  // M_t + p_q = 2 pi (F - <f>)
  return 2 * std::numbers::pi * force;
}

/// Source of the momentum of one cell by a contact ratio a(x), from <1 - cos u> and the squares of a at the left face,
/// the centre and the right face of the cell: -integral of <1 - cos u> d(a^2), by Simpson's rule. No derivative of a
/// is needed.
struct AcrossCell {
  double left, centre, right;
};
inline double contact_source(const AcrossCell& substrate, const AcrossCell& a2) {  // ... - <1 - cos u> (a^2)_x
  return -(substrate.left * (4 * a2.centre - 3 * a2.left - a2.right) + 4 * substrate.centre * (a2.right - a2.left) +
           substrate.right * (a2.left - 4 * a2.centre + 3 * a2.right)) /
         6;
}

/// Velocity at phi + step less that at phi, without cancellation; over `unit`.
inline double velocity_jump(double phi, double step, double unit = 1) {
  return std::sinh(step) / unit / (std::cosh(phi + step) * std::cosh(phi));
}

/// Pressure at `to` less that at `from`, without cancellation; over the square of `unit`.
inline double pressure_jump(double from, double to, double unit = 1) {
  return 2 * (std::sinh(to + from) / unit) * (std::sinh(to - from) / unit);
}

}  // namespace slipfront::modulation
