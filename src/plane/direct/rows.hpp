#pragma once
/// \file
/// The equation of every line on rows of sites, to fourth order in space and time. With the acceleration
///     v = u_xx + u_yy - a^2 sin u
/// a step without friction is
///     u(t + dt) = 2 u - u(t - dt) + dt^2 (v + dt^2 / 12 v_tt),   v_tt = v_xx + v_yy - a^2 (cos u v - sin u u_t^2).

#include <array>
#include <cstddef>

namespace slipfront::plane {

/// Spacings of the sites. Pointers to rows are to their first site, not to the ghosts before it.
struct RowShape {
  std::size_t sites = 0;
  double per_hx2 = 0, per_hy2 = 0;  ///< 1 / spacing^2
};

/// A row, with the two rows below and above it.
using FiveRows = std::array<const double*, 5>;

/// result = f_xx + f_yy of the middle row, which reads two sites on each side of it.
void laplacian(const RowShape& shape, const FiveRows& f, double* result);

/// v += force - a^2 sin u, or 0 where the interface is held. `contact2`, `moves` and `force` may be null.
void add_substrate(std::size_t sites, const double* u, const double* contact2, const double* moves, const double* force,
                   double* v);

/// rate = v_tt from `rate`, which has v_xx + v_yy on entry, and from u_t.
void add_substrate_rate(std::size_t sites, const double* u, const double* v, const double* u_t, const double* contact2,
                        const double* moves, double* rate);

/// One step without friction: `old` has u(t - dt) on entry and u(t + dt) on return. `v_tt` has v_xx + v_yy on entry.
void step_row(std::size_t sites, double dt, const double* u, const double* v, const double* contact2,
              const double* moves, double* v_tt, double* old);

/// Slows a step from u(t - dt), `before`, to u(t + dt), `after`, by the implicit friction C (after - before) / (2 dt).
void rub_viscous(std::size_t sites, double dt, const double* viscous, const double* before, double* after);

/// Sum of 1 - cos u, times a^2 unless `contact2` is null.
double substrate_energy(std::size_t sites, const double* u, const double* contact2);

}  // namespace slipfront::plane
