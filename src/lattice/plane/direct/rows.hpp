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

/// The forces on a row of sites. Each may be null.
struct RowForces {
  const double* contact2 = nullptr;  ///< a^2
  const double* force = nullptr;     ///< added to the acceleration
  const double* moves = nullptr;     ///< 0 where the interface is held, else 1
};
/// Finds the acceleration v = moves (u_xx + u_yy - a^2 sin u + force) of the middle row, and the sine and the cosine in
/// it.
struct Acceleration {
  double *v, *sine, *cosine;  ///< sine: a^2 sin u; cosine: a^2 cos u
};
void accelerate(const RowShape& shape, const FiveRows& u, const RowForces& forces, const Acceleration& result);

/// One step without friction from the acceleration of the middle row. `rated` are accelerations of five rows whose
/// change in time counts. `old` has u(t - dt) on entry and u(t + dt) on return. `v_tt` becomes v_tt. `moves` may be
/// null.
void step_row(const RowShape& shape, double dt, const double* u, const Acceleration& now, const FiveRows& rated,
              const double* moves, double* v_tt, double* old);

/// rate = v_tt from `rate`, which has v_xx + v_yy on entry, for the velocity `u_t`, or for rest if it is null.
void add_substrate_rate(std::size_t sites, const double* v, const double* u_t, const Acceleration& now,
                        const double* moves, double* rate);

/// Accelerations without friction of sites in the middle of a step, one step before, and their rate.
struct Rates {
  const double *v, *v_tt;
  double* v_old;
};
/// Slows a step from u(t - dt), `before`, to u(t + dt), `after`, by the implicit friction C D, D = (after - before) /
/// (2 dt). Returns its work over dt, which is that of u_t = D - dt^2 / 6 v_t. `v_old` becomes `v`.
double rub_viscous(std::size_t sites, double dt, const double* viscous, const Rates& rates, const double* before,
                   double* after);

/// Work of a force in the middle of a step from `before` to `after`, over two steps.
double work_of(std::size_t sites, const double* force, const double* before, const double* after);

/// Sum of 1 - cos u, times a^2 unless `contact2` is null.
double substrate_energy(std::size_t sites, const double* u, const double* contact2);

}  // namespace slipfront::plane
