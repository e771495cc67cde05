#include "lattice/plane/direct/rows.hpp"

#include <cmath>
#include <cstddef>

#include "math/simd/elementary.hpp"
#include "math/simd/vector_code.hpp"

namespace slipfront::plane {
namespace {

/// Smaller displacements count as 0. Ahead of the waves they fall without end, and a processor takes a hundred times
/// longer for numbers near the smallest one.
constexpr double least = 1e-100;

/// Sine and cosine of half of u, from which those of u follow without cancellation.
struct HalfAngle {
  double sine, cosine;

  [[gnu::always_inline]] explicit HalfAngle(double u) {
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
  [[gnu::always_inline]] double sin_u() const { return 2 * sine * cosine; }
  [[gnu::always_inline]] double one_minus_cos_u() const { return 2 * sine * sine; }
};

}  // namespace

namespace {

/// The Laplacian of fourth order at a site of the middle one of five rows.
struct Laplacian {
  double x2, x1, y2, y1, centre;
  const double *lowest, *low, *f, *high, *highest;

  [[gnu::always_inline]] Laplacian(const RowShape& shape, const FiveRows& rows)
      : x2(-shape.per_hx2 / 12),
        x1(4 * shape.per_hx2 / 3),
        y2(-shape.per_hy2 / 12),
        y1(4 * shape.per_hy2 / 3),
        centre(-2.5 * (shape.per_hx2 + shape.per_hy2)),
        lowest(rows[0]),
        low(rows[1]),
        f(rows[2]),
        high(rows[3]),
        highest(rows[4]) {}
  [[gnu::always_inline]] double operator()(std::ptrdiff_t i) const {
    return centre * f[i] + x1 * (f[i - 1] + f[i + 1]) + x2 * (f[i - 2] + f[i + 2]) + y1 * (low[i] + high[i]) +
           y2 * (lowest[i] + highest[i]);
  }
};

// Each loop has one version with a varying contact, or held sites, and one without: a test in the loop would make it
// load from null.

template <bool varying, bool loaded, bool held>
[[gnu::always_inline]] inline void accelerate(const RowShape& shape, const FiveRows& u, const RowForces& forces,
                                              const Acceleration& result) {
  const double *const contact2 = forces.contact2, *const force = forces.force, *const moves = forces.moves;
  const Laplacian bend(shape, u);
  double *const v = result.v, *const sine = result.sine, *const cosine = result.cosine;
  const auto sites = static_cast<std::ptrdiff_t>(shape.sites);
  SLIPFRONT_INDEPENDENT
  for (std::ptrdiff_t i = 0; i < sites; ++i) {
    const HalfAngle at(bend.f[i]);
    double s = at.sin_u(), c = 1 - at.one_minus_cos_u();
    if constexpr (varying) {
      s *= contact2[i];
      c *= contact2[i];
    }
    sine[i] = s;
    cosine[i] = c;
    double a = bend(i) - s;
    if constexpr (loaded) a += force[i];
    if constexpr (held) a *= moves[i];
    v[i] = a;
  }
}

template <bool varying, bool loaded>
[[gnu::always_inline]] inline void accelerate(const RowShape& shape, const FiveRows& u, const RowForces& forces,
                                              const Acceleration& result) {
  if (forces.moves)
    accelerate<varying, loaded, true>(shape, u, forces, result);
  else
    accelerate<varying, loaded, false>(shape, u, forces, result);
}

template <bool varying>
[[gnu::always_inline]] inline void accelerate(const RowShape& shape, const FiveRows& u, const RowForces& forces,
                                              const Acceleration& result) {
  if (forces.force)
    accelerate<varying, true>(shape, u, forces, result);
  else
    accelerate<varying, false>(shape, u, forces, result);
}

template <bool held>
[[gnu::always_inline]] inline void step_free(const RowShape& shape, double dt, const double* u, const Acceleration& now,
                                             const FiveRows& rated, const double* moves, double* v_tt, double* old) {
  const Laplacian bend(shape, rated);
  const double *const v = now.v, *const sine = now.sine, *const cosine = now.cosine;
  const double dt2 = dt * dt, per_dt = 1 / dt;
  const auto sites = static_cast<std::ptrdiff_t>(shape.sites);
  SLIPFRONT_INDEPENDENT
  for (std::ptrdiff_t i = 0; i < sites; ++i) {
    const double gained = u[i] - old[i], u_t = gained * per_dt + 0.5 * dt * v[i];
    double rate = bend(i);
    if constexpr (held) rate *= moves[i];  // the other terms are 0 where v and u_t are
    rate -= cosine[i] * v[i] - sine[i] * (u_t * u_t);
    const double next = u[i] + (gained + dt2 * (v[i] + dt2 / 12 * rate));
    v_tt[i] = rate;
    old[i] = std::fabs(next) < least ? 0 : next;
  }
}

template <class Value>
[[gnu::always_inline]] inline double sum(std::size_t sites, const Value& value) {
  return reduce(sites, 0.0, value, [](double a, double b) { return a + b; });
}

inline void multiply(std::size_t sites, const double* factor, double* f) {
  SLIPFRONT_INDEPENDENT
  for (std::size_t i = 0; i < sites; ++i) f[i] *= factor[i];
}

}  // namespace

SLIPFRONT_CLONES void laplacian(const RowShape& shape, const FiveRows& rows, double* result) {
  const Laplacian bend(shape, rows);
  const auto sites = static_cast<std::ptrdiff_t>(shape.sites);
  SLIPFRONT_INDEPENDENT
  for (std::ptrdiff_t i = 0; i < sites; ++i) result[i] = bend(i);
}

SLIPFRONT_CLONES void accelerate(const RowShape& shape, const FiveRows& u, const RowForces& forces,
                                 const Acceleration& result) {
  if (forces.contact2)
    accelerate<true>(shape, u, forces, result);
  else
    accelerate<false>(shape, u, forces, result);
}

SLIPFRONT_CLONES void step_row(const RowShape& shape, double dt, const double* u, const Acceleration& now,
                               const FiveRows& rated, const double* moves, double* v_tt, double* old) {
  if (moves)
    step_free<true>(shape, dt, u, now, rated, moves, v_tt, old);
  else
    step_free<false>(shape, dt, u, now, rated, moves, v_tt, old);
}

SLIPFRONT_CLONES void add_substrate_rate(std::size_t sites, const double* v, const double* u_t, const Acceleration& now,
                                         const double* moves, double* rate) {
  for (std::size_t i = 0; i < sites; ++i) rate[i] -= now.cosine[i] * v[i] - now.sine[i] * (u_t ? u_t[i] * u_t[i] : 0);
  if (moves) multiply(sites, moves, rate);
}

SLIPFRONT_CLONES double rub_viscous(std::size_t sites, double dt, const double* viscous, const Rates& rates,
                                    const double* before, double* after) {
  const double *const v = rates.v, *const v_tt = rates.v_tt;
  double* const v_old = rates.v_old;
  const double half = 0.5 * dt, per_dt = 1 / dt, per_two_dt = 0.5 / dt, excess = dt * dt / 6;
  return dt * sum(sites, [=](std::size_t i) {
           const double step = (after[i] - before[i]) / (1 + half * viscous[i]);
           after[i] = before[i] + step;
           const double v_t = (v[i] - v_old[i]) * per_dt + half * v_tt[i];
           v_old[i] = v[i];
           const double u_t = step * per_two_dt - excess * v_t;
           return viscous[i] * u_t * u_t;
         });
}

SLIPFRONT_CLONES double work_of(std::size_t sites, const double* force, const double* before, const double* after) {
  return sum(sites, [=](std::size_t i) { return force[i] * (after[i] - before[i]); }) / 2;
}

// A plain loop, because emscripten 3.1 compiles a sum of these terms in lanes wrongly.
SLIPFRONT_CLONES double substrate_energy(std::size_t sites, const double* u, const double* contact2) {
  double sum = 0;
  if (contact2)
    for (std::size_t i = 0; i < sites; ++i) sum += contact2[i] * HalfAngle(u[i]).one_minus_cos_u();
  else
    for (std::size_t i = 0; i < sites; ++i) sum += HalfAngle(u[i]).one_minus_cos_u();
  return sum;
}

}  // namespace slipfront::plane
