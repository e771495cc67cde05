#include "friction/laws/rate_and_state_loops.hpp"

#include <cmath>

#include "math/simd/vector_code.hpp"

namespace slipfront::friction {
namespace {

constexpr double most_exponent = 300;  ///< limit of |ln G|, because asinh_branch_free needs x < 1e150

}  // namespace

namespace {

const double most_G = std::exp(most_exponent), least_G = 1 / most_G;

template <bool of_G>
[[gnu::always_inline]] inline bool forces_in_loop(const AsinhForce& r, std::size_t size, const double* speed,
                                                  const double* theta, double* force) {
  const double least = least_G, most = most_G;
  std::size_t outside = 0;
  SLIPFRONT_INDEPENDENT
  for (std::size_t j = 0; j < size; ++j) {
    double G = theta[j];
    if constexpr (!of_G)
      G = exp_branch_free(at_most(at_least(r.exponent_branch_free(G), -most_exponent), most_exponent));
    const double x = at_most(speed[j] * at_most(G, most), 1e150);
    force[j] = r.a * asinh_branch_free(x, std::sqrt(1 + x * x));
    outside += (G > least && G < most) ? 0u : 1u;
  }
  return outside == 0;
}

}  // namespace

SLIPFRONT_CLONES bool forces(const AsinhForce& law, std::size_t size, const double* speed, const double* theta,
                             double* force) {
  const AsinhForce r = law;
  return r.is_of_G() ? forces_in_loop<true>(r, size, speed, theta, force)
                     : forces_in_loop<false>(r, size, speed, theta, force);
}

bool within_exponents(const AsinhForce& law, double theta) {
  return std::fabs(law.exponent(theta)) < most_exponent - 1;
}

namespace {

constexpr std::size_t together = 64;  ///< positions in one pass
/// Smallest speed in the loops. Squares of smaller numbers would be subnormal, which takes a processor a hundred times
/// longer. Below this speed the solution is linear in the speed.
constexpr double slowest = 1e-100;

/// State of the solves at up to `together` positions.
struct Solves {
  double s[together];  ///< asinh(G v)
  double G[together];
  double late[together];  ///< 1 if the position is not solved yet, else 0
};

/// Quantities that start_series computes and sum_series uses.
struct SeriesStart {
  double root[together], step[together], inverse[together];
};

/// Prepares the solution of v + d asinh(G v) = F by a series. With s = asinh(G v) and c = 1 / G, the equation becomes
/// F / c = sinh s + (d / c) s. We write s = asinh(F G) - delta, where delta obeys
///     R sinh(delta) + d delta - F (cosh(delta) - 1) = d asinh(F G),    R = (F^2 + c^2)^(1/2).
/// The solution is a series in delta_1 = d asinh(F G) / (R + d). This function computes asinh(F G) and delta_1.
/// The loops are short, over at most `together` positions, so that a processor works on many iterations at once. In one
/// long loop, each operation would wait for the one before it.
SLIPFRONT_CLONES void start_series(const AsinhForce& law, std::size_t size, const double* free, double weight,
                                   const double* theta, Solves& at, SeriesStart& start) {
  const AsinhForce r = law;
  const double d = weight * r.a;
  double *const s = at.s, *const G_out = at.G, *const root = start.root;
  double *const step_at = start.step, *const inverse_at = start.inverse;
  if (r.is_of_G()) {
    const double least = least_G, most = most_G;
    SLIPFRONT_INDEPENDENT
    for (std::size_t j = 0; j < size; ++j) G_out[j] = at_most(at_least(theta[j], least), most);
  } else {
    SLIPFRONT_INDEPENDENT
    for (std::size_t j = 0; j < size; ++j) G_out[j] = r.exponent_branch_free(theta[j]);
    SLIPFRONT_INDEPENDENT
    for (std::size_t j = 0; j < size; ++j)
      G_out[j] = exp_branch_free(at_most(at_least(G_out[j], -most_exponent), most_exponent));
  }
  SLIPFRONT_INDEPENDENT
  for (std::size_t j = 0; j < size; ++j) {
    const double x = at_least(at_least(free[j], slowest) * G_out[j], slowest);
    root[j] = std::sqrt(1 + x * x);
  }
  SLIPFRONT_INDEPENDENT
  for (std::size_t j = 0; j < size; ++j) {
    const double G = G_out[j], x = at_least(at_least(free[j], slowest) * G, slowest), slowed = root[j] + d * G;
    const LogRatio ratio = asinh_ratio(x, root[j]);
    const double both = 1 / (ratio.below * slowed);                                     // one division instead of two
    const double s0 = 2 * ratio.half_log(both * slowed), inverse = both * ratio.below;  // inverse * G = 1 / (R + d)
    s[j] = s0;
    inverse_at[j] = inverse;
    step_at[j] = d * G * s0 * inverse;
  }
}

/// Sums the series. Returns whether it is precise enough at all positions.
SLIPFRONT_CLONES bool sum_series(double d, std::size_t size, const double* free, const SeriesStart& start,
                                 double* speed, Solves& at) {
  const double per_d = 1 / d;
  double *const s = at.s, *const G_out = at.G, *const late = at.late;
  const double *const root = start.root, *const step_at = start.step, *const inverse_at = start.inverse;
  std::size_t more = 0;
  SLIPFRONT_INDEPENDENT
  for (std::size_t j = 0; j < size; ++j) {
    constexpr double least_step = 1e-30;
    const double F = at_least(free[j], slowest), x = at_least(F * G_out[j], slowest);
    const double s0 = s[j], inverse = inverse_at[j], step = step_at[j], k = x * inverse, p = root[j] * inverse;
    const double k2 = k * k;
    const double b3 = k2 / 2 - p / 6, b4 = k * (5.0 / 8 * k2 - 5.0 / 12 * p + 1.0 / 24),
                 b5 = k2 * (7.0 / 8 * k2 - 7.0 / 8 * p + 1.0 / 8) + p * (p * (1.0 / 12) - 1.0 / 120);
    const double delta = step + step * step * (k / 2 + step * (b3 + step * (b4 + step * b5)));
    const double v = F - d * (s0 - delta), shown = at_least(step, least_step), step3 = shown * shown * shown;
    const bool fine = (d * step3 * step3 <= 3e-16 * v) & (v >= F / 2) & (step <= s0 / 2);
    const double scaled = v * at_most(free[j] * (1 / slowest), 1.0), solved = s0 - delta, most = at_most(s0, F * per_d);
    speed[j] = fine ? scaled : 0.0;
    s[j] = step < 0.2 ? solved : most;
    late[j] = fine ? 0.0 : 1.0;
    more += fine ? 0u : 1u;
  }
  return more == 0;
}

/// Takes a step of Newton's method in s, from above the root or near it, which converges because the left side is
/// convex. Returns whether any position is still unsolved.
SLIPFRONT_CLONES bool newton_step(double d, std::size_t size, const double* free, double* speed, double* s,
                                  const double* G, double* late) {
  std::size_t more = 0;
  SLIPFRONT_INDEPENDENT
  for (std::size_t j = 0; j < size; ++j) {
    const double F = at_least(free[j], slowest), at = s[j], half = 0.5 / G[j];
    const double up = expm1_branch_free(at_least(at_most(at, 650.0), 0.0)), down = up / (1 + up);
    const double v = half * (up + down), slope = half * (2 + up - down);
    const double step = (v + d * at - F) / (slope + d), next = at - step;
    // The difference `rest` is more precise if friction is weak. The speed, extrapolated to `next`, is more precise if
    // friction is strong.
    const double rest = F - d * next, moved = v - step * (slope - step / 2 * v);
    const bool waits = late[j] != 0, near = std::fabs(step) <= 1e-8 * at;
    const double found = (rest > F / 2 ? rest : moved) * (free[j] < slowest ? free[j] * (1 / slowest) : 1.0);
    speed[j] = (waits & near) ? found : speed[j];
    s[j] = waits ? next : at;
    late[j] = (waits & !near) ? 1.0 : 0.0;
    more += (waits & !near) ? 1u : 0u;
  }
  return more != 0;
}

SLIPFRONT_CLONES bool find_done(std::size_t size, const double* G, const double* late, double* done) {
  std::size_t others = 0;
  SLIPFRONT_INDEPENDENT
  for (std::size_t j = 0; j < size; ++j) {
    const bool found = (late[j] == 0) & (G[j] > 1e-129) & (G[j] < 1e129);
    done[j] = found ? 1.0 : 0.0;
    others += found ? 0u : 1u;
  }
  return others == 0;
}

}  // namespace

bool speeds_after(const AsinhForce& law, std::size_t size, const double* free, double weight, const double* theta,
                  double* speed, double* done) {
  Solves at;  // size <= together
  SeriesStart start;
  start_series(law, size, free, weight, theta, at, start);
  if (!sum_series(weight * law.a, size, free, start, speed, at)) {
    constexpr int most_steps = 40;
    for (int i = 0; i < most_steps; ++i)
      if (!newton_step(weight * law.a, size, free, speed, at.s, at.G, at.late)) break;
  }
  return find_done(size, at.G, at.late, done);
}

}  // namespace slipfront::friction
