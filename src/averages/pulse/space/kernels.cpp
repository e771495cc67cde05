#include "averages/pulse/space/kernels.hpp"

#include <algorithm>
#include <cmath>

#include "math/simd/elementary.hpp"
#include "math/simd/elliptic_fit.hpp"
#include "math/simd/vector_code.hpp"
#include "math/weno.hpp"
#include "theory/modulation/equations.hpp"

namespace slipfront::pulse {

namespace {

/// Second and fourth differences; none where the values are not smooth on the grid, the fourth sooner than the second.
struct Differences {
  double second, fourth;
  explicit Differences(const double* f) {
    const double d0 = f[-2] - 2 * f[-1] + f[0], d1 = f[-1] - 2 * f[0] + f[1], d2 = f[0] - 2 * f[1] + f[2];
    const double d = d0 - 2 * d1 + d2, size = std::fabs(d0) + 2 * std::fabs(d1) + std::fabs(d2);
    const bool smooth = std::fabs(d) < 0.5 * size;
    second = smooth ? d1 : 0.0;
    fourth = std::fabs(d) < 0.2 * size ? d : 0.0;
  }
};

/// Those of `part` that have two neighbours among `size` on either side.
inline CellRange inside(std::size_t size, CellRange part) {
  const std::size_t begin = std::min(std::max<std::size_t>(part.begin, 2), part.end);
  return {begin, std::max(begin, std::min(part.end, size > 2 ? size - 2 : 0))};
}

}  // namespace

// mean = value + d2 / 24 - 17 d4 / 5760, value = mean - d2 / 24 + 3 d4 / 640: sixth order.
SLIPFRONT_CLONES void centre_values(std::size_t size, CellRange part, const double* averages, double* values) {
  const CellRange inner = inside(size, part);
  SLIPFRONT_INDEPENDENT
  for (std::size_t i = inner.begin; i < inner.end; ++i) {
    const Differences d(averages + i);
    values[i] = averages[i] - d.second * (1.0 / 24) + d.fourth * (3.0 / 640);
  }
  for (std::size_t i = part.begin; i < inner.begin; ++i) values[i] = averages[i];
  for (std::size_t i = inner.end; i < part.end; ++i) values[i] = averages[i];
}

SLIPFRONT_CLONES void cell_means(std::size_t size, CellRange part, const double* values, double* averages) {
  const CellRange inner = inside(size, part);
  SLIPFRONT_INDEPENDENT
  for (std::size_t i = inner.begin; i < inner.end; ++i) {
    const Differences d(values + i);
    averages[i] = values[i] + d.second * (1.0 / 24) - d.fourth * (17.0 / 5760);
  }
  for (std::size_t i = part.begin; i < inner.begin; ++i) averages[i] = values[i];
  for (std::size_t i = inner.end; i < part.end; ++i) averages[i] = values[i];
}

SLIPFRONT_CLONES void weno_faces(std::size_t faces, const double* plus, const double* minus, double scale, double* phi,
                                 double* psi) {
  SLIPFRONT_INDEPENDENT
  for (std::size_t f = 0; f < faces; ++f) {
    const double* p = plus + f;
    const double* m = minus + f;
    const Weno5 left(p[-3], p[-2], p[-1], p[0], p[1]), right(m[2], m[1], m[0], m[-1], m[-2]);
    const double inverse = 1 / (left.below * right.below);
    const double from_left = left.above * right.below * inverse, from_right = right.above * left.below * inverse;
    phi[f] = (from_left + from_right) / 2 * scale;
    const double half = (from_left - from_right) / 2;
    psi[f] = (half > 0 ? half : 0.0) * scale;
  }
}

SLIPFRONT_CLONES void face_fluxes(std::size_t faces, const double* phi, const double* psi, double rounding, double* U,
                                  double* p) {
  SLIPFRONT_INDEPENDENT
  for (std::size_t f = 0; f < faces; ++f) {
    const modulation::Fluxes at = modulation::fluxes(phi[f], psi[f]);
    U[f] = std::fabs(phi[f]) > rounding * psi[f] ? at.velocity : 0.0;
    p[f] = at.pressure;
  }
}

SLIPFRONT_CLONES void per_dislocation(std::size_t size, const double* per_charge, const double* width, double* spacing,
                                      double* momentum) {
  SLIPFRONT_INDEPENDENT
  for (std::size_t i = 0; i < size; ++i) {
    spacing[i] = centre_width(spacing[i], width[i]) * per_charge[i];
    momentum[i] *= per_charge[i];
  }
}

namespace {

inline double larger(double a, double b) { return b > a ? b : a; }
inline double smaller(double a, double b) { return b < a ? b : a; }

}  // namespace

SLIPFRONT_CLONES double invariants(std::size_t size, const double* phi, const double* psi, double* plus,
                                   double* minus) {
  const double scale = reduce(
      size, 0, [=](std::size_t i) { return std::fabs(phi[i]) + psi[i]; }, larger);
  const double inverse = scale > 0 ? 1 / scale : 1;
  SLIPFRONT_INDEPENDENT
  for (std::size_t i = 0; i < size; ++i) {
    plus[i] = (phi[i] + psi[i]) * inverse;
    minus[i] = (phi[i] - psi[i]) * inverse;
  }
  return scale;
}

SLIPFRONT_CLONES double hardest_collision(std::size_t size, const double* plus, const double* minus, double share) {
  const double *left_plus = plus - 1, *left_minus = minus - 1;
  return reduce(
      size, -HUGE_VAL,
      [=](std::size_t i) {
        const double fall = left_plus[i] + left_minus[i] - plus[i + 1] - minus[i + 1];
        return fall - share * (left_plus[i] - left_minus[i] + plus[i + 1] - minus[i + 1]);
      },
      larger);
}

SLIPFRONT_CLONES void differences(std::size_t size, const double* U, const double* p, double rounding,
                                  double* width_rate, double* momentum_rate) {
  SLIPFRONT_INDEPENDENT
  for (std::size_t i = 0; i < size; ++i) {
    const double push = p[i] - p[i + 1];
    width_rate[i] = U[i + 1] - U[i];
    momentum_rate[i] = std::fabs(push) > rounding * 0.5 * (p[i] + p[i + 1]) ? push : 0.0;
  }
}

SLIPFRONT_CLONES void fastest_slip(std::size_t size, const double* phi, const double* psi, double* fastest) {
  SLIPFRONT_INDEPENDENT
  for (std::size_t i = 0; i < size; ++i) {
    const double up = expm1_branch_free(std::fabs(phi[i])), tall = exp_branch_free(psi[i]);
    const double wide = 1 + up, inverse = 1 / (wide * tall);
    fastest[i] = (up + up * tall * inverse) * (tall + wide * inverse) / 2;  // (up + up / wide) (tall + 1 / tall) / 2
  }
}

SLIPFRONT_CLONES void free_momenta(const FreeArrays& a, double time) {
  constexpr double least = 1e-280, rounding = 16 * 2.2e-16;
  const double *charge = a.charge, *contact = a.contact, *width = a.width, *free = a.free, *s = a.s,
               *at_rest = a.at_rest, *last = a.last;
  double *momentum = a.momentum, *start = a.start, *moves = a.moves, *spacing = a.spacing;
  SLIPFRONT_INDEPENDENT
  for (std::size_t i = 0; i < a.size; ++i) {
    const double q = charge[i], per_charge = 1 / (q > 0 ? q : 1.0), all = std::fabs(free[i]), M = all * per_charge;
    const double s2 = s[i] * s[i], pressure = 2 * s2 / (1 - s2);  // 2 sinh^2 psi
    const bool moving = (q > 0) & (M > least) & (all > rounding * pressure * time) & (M > at_rest[i]);
    moves[i] = moving ? 1.0 : 0.0;
    momentum[i] = M;
    start[i] = last[i] > 0 ? last[i] : M;
    spacing[i] = contact[i] * width[i] * per_charge;
  }
}

SLIPFRONT_CLONES void take_newton_steps(const NewtonArrays& a, double weight, double least) {
  const double *momentum = a.momentum, *free = a.free, *force = a.force, *slope = a.slope;
  double* next = a.next;
  SLIPFRONT_INDEPENDENT
  for (std::size_t i = 0; i < a.size; ++i) {
    const double M = momentum[i], excess = M + weight * force[i] - free[i];
    const double part = weight * slope[i], down = excess / (M + part);
    const bool linear = (part < 0.1 * M) | (slope[i] > 0.7 * force[i]);
    const double limited = down < 8 ? (down > -2 ? down : -2.0) : 8.0;
    const bool stays_linear = linear & (down < 0.9);
    const double share = stays_linear ? 1 - down : exp_branch_free(-limited);
    const double to = slope[i] == 0 ? M - excess : M * share, most = free[i], low = least * free[i];
    next[i] = to > low ? (to < most ? to : most) : low;
  }
}

SLIPFRONT_CLONES void find_after_newton(const NewtonArrays& a, double weight, double last_step, double precision,
                                        const AfterNewton& after) {
  const double *momentum = a.momentum, *free = a.free, *force = a.force, *slope = a.slope, *next = a.next, *s = after.s,
               *U = after.U, *fastest = after.fastest;
  double *velocity = after.velocity, *typical = after.typical, *new_force = after.force, *last = after.last;
  SLIPFRONT_INDEPENDENT
  for (std::size_t i = 0; i < a.size; ++i) {
    const double M = momentum[i], step = next[i] / M - 1, excess = M + weight * force[i] - free[i];
    const bool there = (std::fabs(step) <= last_step) | (std::fabs(excess) <= precision * free[i]);
    last[i] = there ? 1.0 : 0.0;
    velocity[i] = U[i] + (1 - U[i] * U[i]) * U[i] * step;  // sinh phi goes as M
    typical[i] = fastest[i] * (1 + step) / 2 * (1 + s[i]);
    new_force[i] = force[i] + step * slope[i];
  }
}

SLIPFRONT_CLONES double damp(std::size_t size, double rate, const double* momentum, const double* U,
                             double* momentum_rate) {
  SLIPFRONT_INDEPENDENT
  for (std::size_t i = 0; i < size; ++i) momentum_rate[i] -= rate * momentum[i];
  return rate *
         reduce(
             size, 0, [=](std::size_t i) { return U[i] * momentum[i]; }, [](double a, double b) { return a + b; });
}

SLIPFRONT_CLONES double paper_rates(std::size_t size, double coefficient, const double* EK, double* rate) {
  const double most = coefficient * 2.4674011002723397;  // pi^2 / 4
  SLIPFRONT_INDEPENDENT
  for (std::size_t i = 0; i < size; ++i) rate[i] = EK[i] > 0 ? most / EK[i] : coefficient;
  return reduce(
      size, 0, [=](std::size_t i) { return rate[i]; }, larger);
}

SLIPFRONT_CLONES double least_crossing_time(std::size_t size, const double* width, const double* width_rate,
                                            const double* U, const double* c0) {
  return reduce(
      size, HUGE_VAL,
      [=](std::size_t i) {
        const double slowed = 1 - std::fabs(U[i]) * c0[i];
        return width[i] * slowed / larger(c0[i] * (1 - U[i] * U[i]), -width_rate[i] * slowed * (1 / 0.3));
      },
      smaller);
}

SLIPFRONT_CLONES void masses_and_pressures(const StaggeredCells& a) {
  const double *spacing = a.spacing, *phi = a.phi, *psi = a.psi, *EK = a.EK, *contact = a.contact, *left = a.on_one,
               *right = a.on_one + 1;
  double *mass = a.mass, *pressure = a.pressure;
  SLIPFRONT_INDEPENDENT
  for (std::size_t i = 0; i < a.size; ++i) {
    const double e = exp_branch_free(std::fabs(phi[i]));
    mass[i] = 4 * EK[i] / (spacing[i] * (e + 1 / e));  // l = 2 K / (cosh phi cosh psi)
  }
  SLIPFRONT_INDEPENDENT
  for (std::size_t i = 0; i < a.size; ++i) {
    const double per_mass = 1 / (8 * contact[i] * mass[i]), x1 = left[i] * per_mass, x2 = right[i] * per_mass;
    const double root1 = std::sqrt(1 + x1 * x1), root2 = std::sqrt(1 + x2 * x2), crossed = x1 * root2,
                 other = x2 * root1;
    // sinh of what their rapidities close by, without cancellation.
    const double apart = (x1 - x2) * (x1 + x2) / (x1 * x2 > 0 ? crossed + other : 1.0);
    const double sinh = x1 * x2 > 0 ? apart : crossed - other, closing = sinh > 0 ? sinh : 0.0;
    const double more = closing + closing * closing / (1 + std::sqrt(1 + closing * closing));
    const double up = expm1_branch_free(2 * psi[i]), all = up + more + up * more;  // e^(2 psi + closing) - 1
    pressure[i] = modulation::pressure_from(all);
  }
}

SLIPFRONT_CLONES void face_velocities(std::size_t faces, const double* on_one, const double* mass, double* sinh_phi,
                                      double* cosh_phi, double* U) {
  SLIPFRONT_INDEPENDENT
  for (std::size_t f = 0; f < faces; ++f) {
    const double x = on_one[f] / mass[f], root = std::sqrt(1 + x * x);
    sinh_phi[f] = x;
    cosh_phi[f] = root;
    U[f] = x / root;
  }
}

SLIPFRONT_CLONES void find_trains(const TrainsAtFaces& a, double creep) {
  const double *sinh_phi = a.sinh_phi, *psi = a.psi, *contact = a.contact;
  double *fastest = a.fastest, *s_out = a.s, *per_momentum = a.per_momentum;
  constexpr double least = 1e-290, at_rest = 1e-8, turn = 6.283185307179586;
  SLIPFRONT_INDEPENDENT
  for (std::size_t i = 0; i < a.size; ++i) {
    const double size = std::fabs(sinh_phi[i]), large = size > creep ? size : creep,
                 small = size > creep ? creep : size;
    const double ratio = large > 0 ? small / large : 0.0, limit = at_rest * (psi[i] < 1 ? psi[i] : 1.0);
    const double some_x = large > 0 ? large * std::sqrt(1 + ratio * ratio) : limit, x = some_x > least ? some_x : least;
    const double up = expm1_branch_free(2 * psi[i]), s = up / (2 + up), some = s > least ? s : least, m1 = some * some;
    const double E = 1 + m1 * (polynomial(fit::E, m1) - 2 * log_branch_free(some) * polynomial(fit::E_log, m1));
    const double slip = contact[i] * x * (2 + up) / (2 * std::sqrt(1 + up));  // times cosh psi
    fastest[i] = 2 * slip;
    s_out[i] = s;
    const double per = turn / (8 * slip * E);
    per_momentum[i] = psi[i] > 0 ? (s < fit::largest_s ? per : NAN) : 0.0;
  }
}

}  // namespace slipfront::pulse
