#include "plane/direct/rows.hpp"

#include <cmath>

#include "foundation/simd/elementary.hpp"
#include "foundation/simd/vector_code.hpp"

namespace slipfront::plane {
namespace {

/// Smaller displacements count as 0. Ahead of the waves they fall without end, and a processor takes a hundred times
/// longer for numbers near the smallest one.
constexpr double least = 1e-100;

/// Sine and cosine of half of u, from which those of u follow without cancellation.
struct HalfAngle {
  double sine, cosine;

  explicit HalfAngle(double u) {
    constexpr double magic = 6755399441055744.0;  // adding it rounds to a whole number
    const double turns = (u * 0.15915494309189535 + magic) - magic;
    const double h = 0.5 * ((u - turns * 6.28318530717958623) - turns * 2.4492935982947064e-16), z = h * h;
    constexpr double s[] = {-1.0 / 6,
                            1.0 / 120,
                            -1.0 / 5040,
                            1.0 / 362880,
                            -1.0 / 39916800.0,
                            1.0 / 6227020800.0,
                            -1.0 / 1307674368000.0,
                            1.0 / 355687428096000.0};
    constexpr double c[] = {-1.0 / 2,         1.0 / 24,          -1.0 / 720,           1.0 / 40320,
                            -1.0 / 3628800.0, 1.0 / 479001600.0, -1.0 / 87178291200.0, 1.0 / 20922789888000.0};
    sine = h + h * (z * polynomial(s, z));
    cosine = 1 + z * polynomial(c, z);
  }
  double sin_u() const { return 2 * sine * cosine; }
  double one_minus_cos_u() const { return 2 * sine * sine; }
};

}  // namespace

SLIPFRONT_CLONES void laplacian(const RowShape& shape, const FiveRows& rows, double* result) {
  const double x2 = -shape.per_hx2 / 12, x1 = 4 * shape.per_hx2 / 3, y2 = -shape.per_hy2 / 12,
               y1 = 4 * shape.per_hy2 / 3, centre = -2.5 * (shape.per_hx2 + shape.per_hy2);
  const double *const lowest = rows[0], *const low = rows[1], *const f = rows[2], *const high = rows[3],
                      *const highest = rows[4];
  const auto sites = static_cast<std::ptrdiff_t>(shape.sites);
  SLIPFRONT_INDEPENDENT
  for (std::ptrdiff_t i = 0; i < sites; ++i)
    result[i] = centre * f[i] + x1 * (f[i - 1] + f[i + 1]) + x2 * (f[i - 2] + f[i + 2]) + y1 * (low[i] + high[i]) +
                y2 * (lowest[i] + highest[i]);
}

namespace {

// Each loop has one version with a varying contact and one without: a test in the loop would make it load from null.

/// a^2, or 1.
template <bool varying>
struct Contact {
  const double* a2;
  double operator[](std::size_t i) const {
    if constexpr (varying)
      return a2[i];
    else
      return 1;
  }
};

template <bool varying>
[[gnu::always_inline]] inline void subtract_sine(std::size_t sites, const double* u, Contact<varying> a2, double* v) {
  SLIPFRONT_INDEPENDENT
  for (std::size_t i = 0; i < sites; ++i) v[i] -= a2[i] * HalfAngle(u[i]).sin_u();
}

template <bool varying>
[[gnu::always_inline]] inline void subtract_rate(std::size_t sites, const double* u, const double* v, const double* u_t,
                                                 Contact<varying> a2, double* rate) {
  SLIPFRONT_INDEPENDENT
  for (std::size_t i = 0; i < sites; ++i) {
    const HalfAngle at(u[i]);
    rate[i] -= a2[i] * ((1 - at.one_minus_cos_u()) * v[i] - at.sin_u() * u_t[i] * u_t[i]);
  }
}

template <bool varying>
[[gnu::always_inline]] inline void step_free(std::size_t sites, double dt, const double* u, const double* v,
                                             Contact<varying> a2, const double* v_tt, double* old) {
  const double dt2 = dt * dt, per_dt = 1 / dt;
  SLIPFRONT_INDEPENDENT
  for (std::size_t i = 0; i < sites; ++i) {
    const HalfAngle at(u[i]);
    const double gained = u[i] - old[i], u_t = gained * per_dt + 0.5 * dt * v[i];
    const double rate = v_tt[i] - a2[i] * ((1 - at.one_minus_cos_u()) * v[i] - at.sin_u() * u_t * u_t);
    const double next = u[i] + (gained + dt2 * (v[i] + dt2 / 12 * rate));
    old[i] = std::fabs(next) < least ? 0 : next;
  }
}

inline void multiply(std::size_t sites, const double* factor, double* f) {
  SLIPFRONT_INDEPENDENT
  for (std::size_t i = 0; i < sites; ++i) f[i] *= factor[i];
}

}  // namespace

SLIPFRONT_CLONES void add_substrate(std::size_t sites, const double* u, const double* contact2, const double* moves,
                                    const double* force, double* v) {
  if (contact2)
    subtract_sine<true>(sites, u, {contact2}, v);
  else
    subtract_sine<false>(sites, u, {}, v);
  if (force)
    for (std::size_t i = 0; i < sites; ++i) v[i] += force[i];
  if (moves) multiply(sites, moves, v);
}

SLIPFRONT_CLONES void add_substrate_rate(std::size_t sites, const double* u, const double* v, const double* u_t,
                                         const double* contact2, const double* moves, double* rate) {
  if (contact2)
    subtract_rate<true>(sites, u, v, u_t, {contact2}, rate);
  else
    subtract_rate<false>(sites, u, v, u_t, {}, rate);
  if (moves) multiply(sites, moves, rate);
}

SLIPFRONT_CLONES void step_row(std::size_t sites, double dt, const double* u, const double* v, const double* contact2,
                               const double* moves, double* v_tt, double* old) {
  if (moves) multiply(sites, moves, v_tt);  // the other terms of v_tt are 0 where v and u_t are
  if (contact2)
    step_free<true>(sites, dt, u, v, {contact2}, v_tt, old);
  else
    step_free<false>(sites, dt, u, v, {}, v_tt, old);
}

SLIPFRONT_CLONES void rub_viscous(std::size_t sites, double dt, const double* viscous, const double* before,
                                  double* after) {
  SLIPFRONT_INDEPENDENT
  for (std::size_t i = 0; i < sites; ++i) after[i] = before[i] + (after[i] - before[i]) / (1 + 0.5 * dt * viscous[i]);
}

SLIPFRONT_CLONES double substrate_energy(std::size_t sites, const double* u, const double* contact2) {
  double sum = 0;
  if (contact2)
    for (std::size_t i = 0; i < sites; ++i) sum += contact2[i] * HalfAngle(u[i]).one_minus_cos_u();
  else
    for (std::size_t i = 0; i < sites; ++i) sum += HalfAngle(u[i]).one_minus_cos_u();
  return sum;
}

}  // namespace slipfront::plane
