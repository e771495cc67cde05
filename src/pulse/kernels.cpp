#include "kernels.hpp"

#include <cmath>
#include <initializer_list>
#include <numbers>

#include "branch_free.hpp"
#include "weno.hpp"

// g++ gets a version for each level of x86-64, chosen at run time. clang 14 knows neither that nor these pragmas (its
// own complain where optimisation is off): its build runs the loops as they come.
#if defined(__GNUC__) && !defined(__clang__)
#define SLIPFRONT_INDEPENDENT _Pragma("GCC ivdep")
#define SLIPFRONT_UNROLL _Pragma("GCC unroll 8")
#else
#define SLIPFRONT_INDEPENDENT
#define SLIPFRONT_UNROLL
#endif
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
#define SLIPFRONT_CLONES __attribute__((target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")))
#else
#define SLIPFRONT_CLONES
#endif

namespace slipfront::pulse {

namespace {

/// K, E/K and E/K - s^2 at s, by the mean of 1 and s with differences c_n without cancellation.
template <class Real, int steps>
struct Mean {
  Real K, ratio, above;
  explicit Mean(Real s) {
    const Real c1 = (1 - s) / 2;
    Real mean = (1 + s) / 2, other = std::sqrt(s), c = c1, tail = 0, weight = 2;
    SLIPFRONT_UNROLL
    for (int k = 0; k < steps; ++k) {
      const Real next = (mean + other) / 2;
      c = c * c / (4 * next);
      tail += weight * c * c;
      weight *= 2;
      other = std::sqrt(mean * other);
      mean = next;
    }
    const Real excess = c1 * c1 - tail;
    K = std::numbers::pi_v<Real> / (mean + other);
    ratio = s + excess;
    above = excess + 2 * s * c1;
  }
};

/// One Newton step in ln s for K - l sqrt(cosh^2 psi + (M / 8E)^2) / 2 = 0; cosh^2 psi = 1 / (1 - s^2).
template <class Real, int steps>
struct NewtonStep {
  Mean<Real, steps> at;
  Real E, m, slope_K, step;
  NewtonStep(Real s, Real half, Real eighth) : at(s), E(at.K * at.ratio), m(1 - s * s), slope_K(-at.above / m * at.K) {
    const Real rapid = eighth / E, rapid_square = rapid * rapid;
    const Real length = half * std::sqrt(1 / m + rapid_square);
    const Real slope_length = half * half / length * (s * s / m) * (1 / m - rapid_square * (1 / at.ratio - 1));
    step = (at.K - length) / (slope_length - slope_K);
  }
};

}  // namespace

SLIPFRONT_CLONES void resolve_all(const ResolveArrays& a) {
  const std::size_t n = a.size;
  const double *spacing = a.spacing, *momentum = a.momentum;
  double *s_out = a.s, *phi = a.phi, *psi = a.psi, *sound = a.sound_speed, *EK = a.EK, *good = a.good;
  constexpr double least = 1e-10, most = 0.9;
  // Two steps in single precision bring the guess to about 1e-6; twice as many lanes, and roots at a quarter of the
  // price.
  SLIPFRONT_INDEPENDENT
  for (std::size_t i = 0; i < n; ++i) {
    const auto half = static_cast<float>(spacing[i] / 2), eighth = static_cast<float>(momentum[i] / 8);
    const double guess = s_out[i];
    good[i] = guess > least && guess < most ? 1.0 : 0.0;
    // A lane out of range computes with a harmless s and is thrown away.
    auto s = static_cast<float>(guess < least ? least : guess > most ? most : guess);
    SLIPFRONT_UNROLL
    for (int iteration = 0; iteration < 2; ++iteration) {
      const float step = NewtonStep<float, 6>(s, half, eighth).step;
      s *= 1 + step * (1 + step / 2);
    }
    // What single precision cannot improve it may spoil: there is nothing to gain if the guess was good.
    s_out[i] = good[i] != 0 ? static_cast<double>(s) : guess;
  }
  SLIPFRONT_INDEPENDENT
  for (std::size_t i = 0; i < n; ++i) {
    const double half = spacing[i] / 2, eighth = momentum[i] / 8, from = s_out[i];
    const bool in_range = from > least && from < most;
    double s = in_range ? from : 0.5;
    const NewtonStep<double, 7> newton(s, half, eighth);
    const double step = newton.step, m = newton.m, ratio = newton.at.ratio;
    // All to this step by derivatives; what is left is of the order of its square.
    const double E = newton.E + s * s * (newton.at.K - newton.E) / m * step;
    sound[i] = s / ratio * (1 + (1 - ratio) * newton.at.above / (m * ratio) * step);
    EK[i] = E * (newton.at.K + newton.slope_K * step);
    s *= 1 + step * (1 + step / 2);
    const bool fine = good[i] != 0 && in_range && std::fabs(step) < 2e-5;
    good[i] = fine ? 1.0 : 0.0;
    s_out[i] = fine ? s : from;
    phi[i] = asinh_branch_free(eighth * std::sqrt(1 - s * s) / E);
    psi[i] = atanh_branch_free(s);
  }
}

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

}  // namespace

// mean = value + d2 / 24 - 17 d4 / 5760, value = mean - d2 / 24 + 3 d4 / 640: sixth order.
SLIPFRONT_CLONES void centre_values(std::size_t size, const double* averages, double* values) {
  SLIPFRONT_INDEPENDENT
  for (std::size_t i = 2; i < size - 2; ++i) {
    const Differences d(averages + i);
    values[i] = averages[i] - d.second / 24 + d.fourth * (3.0 / 640);
  }
  for (const std::size_t i : {std::size_t{0}, std::size_t{1}, size - 2, size - 1}) values[i] = averages[i];
}

SLIPFRONT_CLONES void cell_means(std::size_t size, const double* values, double* averages) {
  SLIPFRONT_INDEPENDENT
  for (std::size_t i = 2; i < size - 2; ++i) {
    const Differences d(values + i);
    averages[i] = values[i] + d.second / 24 - d.fourth * (17.0 / 5760);
  }
  for (const std::size_t i : {std::size_t{0}, std::size_t{1}, size - 2, size - 1}) averages[i] = values[i];
}

SLIPFRONT_CLONES void weno_faces(std::size_t faces, const double* plus, const double* minus, double scale, double* phi,
                                 double* psi) {
  SLIPFRONT_INDEPENDENT
  for (std::size_t f = 0; f < faces; ++f) {
    const double* p = plus + f;
    const double* m = minus + f;
    const double from_left = weno5(p[-3], p[-2], p[-1], p[0], p[1]), from_right = weno5(m[2], m[1], m[0], m[-1], m[-2]);
    phi[f] = (from_left + from_right) / 2 * scale;
    const double half = (from_left - from_right) / 2;
    psi[f] = (half > 0 ? half : 0.0) * scale;
  }
}

SLIPFRONT_CLONES void velocities(std::size_t size, const double* phi, double* U) {
  SLIPFRONT_INDEPENDENT
  for (std::size_t i = 0; i < size; ++i) U[i] = tanh_branch_free(phi[i]);
}

SLIPFRONT_CLONES void face_fluxes(std::size_t faces, const double* phi, const double* psi, double* U, double* p) {
  SLIPFRONT_INDEPENDENT
  for (std::size_t f = 0; f < faces; ++f) {
    const double sinh_psi = sinh_branch_free(psi[f]);
    U[f] = tanh_branch_free(phi[f]);
    p[f] = 2 * sinh_psi * sinh_psi;
  }
}

}  // namespace slipfront::pulse
