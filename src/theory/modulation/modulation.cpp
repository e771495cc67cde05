#include "theory/modulation/modulation.hpp"

#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>

#include "math/digits.hpp"
#include "math/simd/elementary.hpp"
#include "math/simd/elliptic_fit.hpp"
#include "math/simd/vector_code.hpp"
#include "slipfront/error.hpp"
#include "slipfront/math/elliptic.hpp"
#include "slipfront/theory/modulation/modulation.hpp"
#include "slipfront/theory/train.hpp"
#include "theory/modulation/equations.hpp"

namespace slipfront::modulation {

Sound sound(double psi) {
  const elliptic::AtPsi at = elliptic::at_psi(psi);
  const double c0 = at.s / at.ratio;  // tanh(psi) K / E
  const double one_minus = at.excess / at.ratio;
  const double one_minus_square = one_minus * (1 + c0);
  // In the dense limit 1 - c0 = exp(-4 psi) underflows long before its logarithm does.
  const double rapidity = psi > elliptic::psi_dense_above ? 2 * psi + 0.5 * std::log(2.0)
                          : c0 < 0.5                      ? std::atanh(c0)
                                                          : 0.5 * std::log((1 + c0) / one_minus);
  // d(ln c0)/d(psi) = (1 - E/K)(E/K - m1) / (s E/K), from dK/dm and dE/dm.
  const double log_slope = at.deficit * at.above_m1 / (at.s * at.ratio);
  const double slope = psi > elliptic::psi_dense_above ? 2.0 : c0 * log_slope / one_minus_square;
  return {c0, one_minus, rapidity, slope, log_slope};
}

Speeds characteristic_speeds(const State& state) {
  if (state.empty()) return {std::tanh(state.phi), std::tanh(state.phi)};
  const double a = sound(state.psi).rapidity;
  // Eq. (6), for the invariants phi +- psi: (phi +- psi)_t + lambda_+- (phi +- psi)_x = 0.
  return {std::tanh(state.phi - a), std::tanh(state.phi + a)};
}

Pair density(const State& state) {
  const train::Averages a = train::averages(state);
  return {a.k, a.P};
}

Pair flux(const State& state) {
  if (state.empty()) return {0, 0};
  const Pair at = density(state);
  const auto [U, p] = fluxes(state.phi, state.psi);
  return {U * at.number, U * at.momentum + p};
}

namespace {

/// Range of psi in which a double can represent psi and the functions of psi.
constexpr double psi_least = 1e-303, psi_most = 700;

[[noreturn]] void give_up(const LagrangianState& c) {
  throw NumericsError("no state has the spacing " + digits(c.spacing) + " and the momentum " + digits(c.momentum) +
                      " per dislocation");
}

}  // namespace

LagrangianState lagrangian_state(const State& state) {
  const elliptic::AtPsi at = elliptic::at_psi(state.psi);
  const double cosh_psi = std::cosh(state.psi);
  return {2 * at.K / (std::cosh(state.phi) * cosh_psi), 8 * std::sinh(state.phi) * cosh_psi * at.E};
}

namespace {

/// Solves for the state by Newton's method in ln psi, for any density.
SolvedState solve_in_psi(const LagrangianState& c, double psi) {
  const double half = c.spacing / 2;
  for (int iteration = 0; iteration < 80; ++iteration) {
    const elliptic::AtPsi at = elliptic::at_psi(psi);
    const double wide = half * std::cosh(psi);  // cosh, because its square would overflow earlier
    const double rapid = c.momentum * half / (8 * at.E * wide), rapid_square = rapid * rapid;
    const double length = wide * std::sqrt(1 + rapid_square);
    // For small psi, K - length is linear in ln psi. For large psi, ln(K / length) is linear in psi.
    const double slope_K = -at.above_m1 / at.s * at.K;
    double slope_length = wide * (wide / length) * at.s * (1 - rapid_square * (1 / at.ratio - 1));
    // K - length falls near its zero. It may rise far from the zero; there we use only the slope of K.
    if (psi < 1 && slope_length < slope_K) slope_length = 0;
    const double step = psi < 1 ? (at.K - length) / (psi * (slope_length - slope_K))
                                : std::log(at.K / length) / (psi * (slope_length / length - slope_K / at.K));
    if (!std::isfinite(step)) give_up(c);
    const double most = step > 2 ? std::fmax(2, -std::log(psi)) : 2;  // in the linear range, one step may reach psi = 1
    const double limited = std::fmin(std::fmax(step, -40.0), most), before = psi;
    psi *= std::fabs(limited) < 0.1 ? 1 + std::expm1(limited) : std::exp(limited);
    if (psi < psi_least) {  // here E = 1, and the spacing gives K
      const double phi = std::asinh(c.momentum / 8);
      return {{phi, 0}, 0, half * std::cosh(phi)};
    }
    if (psi > psi_most) {
      if (before == psi_most) give_up(c);
      psi = psi_most;
    }
    if (std::fabs(step) < 1e-8) {
      // Derivatives correct for the last step. The remaining error is of the order of step^2.
      const double last = psi - before, c0 = at.s / at.ratio;
      const double E = at.E + at.s * (at.K - at.E) * last;
      const double sound = c0 * (1 + at.deficit * at.above_m1 / (at.s * at.ratio) * last);
      return {{std::asinh(c.momentum / (8 * std::cosh(psi) * E)), psi}, sound, E * (at.K + slope_K * last)};
    }
  }
  give_up(c);
}

}  // namespace

SolvedState solve_state(const LagrangianState& c, double psi_guess) {
  if (!(c.spacing > 0) || !std::isfinite(c.spacing) || !std::isfinite(c.momentum)) give_up(c);
  const double psi = psi_guess > 0 && std::isfinite(psi_guess) ? psi_guess : 1;
  // Newton's method in ln s, s = tanh psi, costs half as much as in ln psi, because cosh^2 psi = 1 / (1 - s^2) needs no
  // hyperbolic function. If a step is large or s leaves its range, we solve in ln psi instead.
  const double half = c.spacing / 2;
  double s = std::tanh(psi);
  for (int iteration = 0; iteration < 8 && s < 0.9 && s > 1e-290; ++iteration) {
    const elliptic::AtPsi at = elliptic::at_modulus(s);
    const double m = 1 - s * s, rapid = c.momentum / (8 * at.E), rapid_square = rapid * rapid;
    const double length = half * std::sqrt(1 / m + rapid_square);
    const double slope_K = -at.above_m1 / m * at.K;
    const double slope_length = half * half / length * (s * s / m) * (1 / m - rapid_square * (1 / at.ratio - 1));
    const double step = (at.K - length) / (slope_length - slope_K);
    if (!(std::fabs(step) < 0.5)) break;
    s *= 1 + step * (1 + step / 2);
    if (std::fabs(step) < 1e-8) {
      const double E = at.E + at.s * at.s * (at.K - at.E) / m * step;
      const double sound = at.s / at.ratio * (1 + at.deficit * at.above_m1 / (m * at.ratio) * step);
      return {
          {std::asinh(c.momentum * std::sqrt(1 - s * s) / (8 * E)), std::atanh(s)}, sound, E * (at.K + slope_K * step)};
    }
  }
  return solve_in_psi(c, psi);
}

State state_of(const LagrangianState& train, double psi_guess) { return solve_state(train, psi_guess).state; }

double mass_excess(double psi) {
  if (psi == 0) return 0;
  const double half = std::sinh(psi / 2);
  return std::cosh(psi) * elliptic::at_psi(psi).E_rest + 2 * half * half;
}

double interaction_energy(double psi) {
  if (psi == 0) return 0;
  return 8 * mass_excess(psi) - pressure(psi) * 2 * elliptic::at_psi(psi).K / std::cosh(psi);
}

namespace {

/// Integral of p(l) - p over the spacing l, from the spacing of a moving train to the spacing in its own frame, where
/// its pressure is p.
double compression_energy(const State& state) {
  constexpr double short_way = 0.1;
  const double half = std::sinh(state.phi / 2), own_spacing = lagrangian_state({0, state.psi}).spacing;
  const double way = own_spacing * 2 * half * half / std::cosh(state.phi), own_pressure = pressure(state.psi);
  const auto psi_at = [&](double spacing) { return state_of({spacing, 0}, state.psi).psi; };
  if (std::fabs(state.phi) > short_way)
    return interaction_energy(psi_at(own_spacing - way)) - interaction_energy(state.psi) - own_pressure * way;
  constexpr double at[3] = {0.1127016653792583, 0.5, 0.8872983346207417}, weight[3] = {5.0 / 18, 4.0 / 9, 5.0 / 18};
  double sum = 0;  // Gauss-Legendre quadrature
  for (int i = 0; i < 3; ++i) sum += weight[i] * (pressure(psi_at(own_spacing - at[i] * way)) - own_pressure);
  return sum * way;
}

}  // namespace

double kinetic_energy(const State& state) {
  const double half = std::sinh(state.phi / 2), isolated = 16 * half * half;
  if (state.empty() || state.phi == 0) return isolated;
  return std::fmax(isolated * (1 + mass_excess(state.psi)) - compression_energy(state), 0.0);
}

namespace {

/// The complete elliptic integrals K and E at m1 = s^2, from `minus_log` = -ln m1.
struct KandE {
  double K, E;
  KandE(double m1, double minus_log)
      : K(polynomial(fit::K, m1) + minus_log * polynomial(fit::K_log, m1)),
        E(1 + m1 * (polynomial(fit::E, m1) + minus_log * polynomial(fit::E_log, m1))) {}
};
struct KandEFloat {
  float K, E;
  KandEFloat(float m1, float minus_log)
      : K(polynomial(fit::K_float, m1) + minus_log * polynomial(fit::K_float_log, m1)),
        E(1 + m1 * (polynomial(fit::E_float, m1) + minus_log * polynomial(fit::E_float_log, m1))) {}
};

/// The step in ln s that solves K = L, L = (l / 2) sqrt(1 / m + (M / 8E)^2), m = 1 - s^2, by Halley's method of third
/// order. K is nearly linear in ln s. We avoid a square root: K - L = K (1 - sqrt(1 - 2x)), where x = (1 - L^2 / K^2) /
/// 2 is small near the solution.
template <class Real>
struct HalleyStep {
  Real slope_K, slope_E, curve_K, curve_E, slope, curve, step;
  HalleyStep(Real K, Real E, Real m1, Real half, Real eighth) {
    const Real m = 1 - m1, inverse = 1 / (K * E * m);  // one division, not three
    const Real per_K = E * m * inverse, per_E = K * m * inverse, per_m = K * E * inverse;
    // Derivatives with respect to ln s.
    const Real up = m1 * per_m;
    slope_K = -(E - m1 * K) * per_m;
    slope_E = up * (K - E);
    curve_K = up * per_m * ((1 + m1) * K - 2 * E);
    curve_E = up * per_m * (2 * (K - E) - E * m);
    const Real rapid = eighth * per_E, rapid_square = rapid * rapid, half_square = half * half;
    const Real e = slope_E * per_E;
    const Real x = (1 - half_square * (per_m + rapid_square) * per_K * per_K) / 2;
    const Real off = K * x * (1 + x / 2 * (1 + x)), per_L = per_K * (1 + x * (1 + x + x / 2));
    // slope_square is L L', and curve_square is its derivative. L L'' = (L L')' - L'^2.
    const Real slope_square = half_square * (up * per_m - rapid_square * e);
    const Real curve_square =
        half_square * (2 * (1 + m1) * up * per_m * per_m - rapid_square * (curve_E * per_E - 3 * e * e));
    const Real slope_L = slope_square * per_L, curve_L = (curve_square - slope_L * slope_L) * per_L;
    slope = slope_L - slope_K;
    curve = curve_L - curve_K;
    step = off * slope / (slope * slope + off * curve / 2);
  }
};

/// ln s for s >= 1e-300, to single precision.
inline float log_float(double s) {
  const std::uint64_t lifted = std::bit_cast<std::uint64_t>(s) + (0x3ff0000000000000u - 0x3fe6a09e667f3bcdu);
  const double e = std::bit_cast<double>((lifted >> 52) | 0x4330000000000000u) - (4503599627370496.0 + 1023.0);
  const double f = std::bit_cast<double>((lifted & 0x000fffffffffffffu) + 0x3fe6a09e667f3bcdu);
  const auto g = static_cast<float>(f - 1);
  return static_cast<float>(e) * 0.693147181f + g * polynomial(fit::log_over_g, g);
}

inline double clamp(double x, double low, double high) { return x > low ? (x < high ? x : high) : low; }

constexpr double least = 1e-290, most = fit::largest_s;  // range of s

/// Improves the guess in single precision, which has twice as many lanes. Stores ln s in `psi`.
SLIPFRONT_CLONES void approach(const StateArrays& a) {
  const double *spacing = a.spacing, *momentum = a.momentum, *s_in = a.s;
  double* psi = a.psi;
  SLIPFRONT_INDEPENDENT
  for (std::size_t i = 0; i < a.size; ++i) {
    const auto half = static_cast<float>(spacing[i] / 2), eighth = static_cast<float>(momentum[i] / 8);
    const double guess = clamp(s_in[i], least, most);
    const auto s = static_cast<float>(guess);
    const float log_s = log_float(guess), m1 = s * s;  // below s = 1e-19, m1 is 0 and the result depends only on ln s
    const KandEFloat at(m1, -2 * log_s);
    psi[i] = static_cast<double>(log_s + HalleyStep<float>(at.K, at.E, m1, half, eighth).step);
  }
}

/// Finds s from ln s in `psi`. On return, the arrays of sound speed, EK and velocity hold K, E and s, also for cells
/// without a solution.
SLIPFRONT_CLONES void solve_from_logarithm(const StateArrays& a) {
  const std::size_t n = a.size;
  const double *spacing = a.spacing, *momentum = a.momentum;
  double *s_out = a.s, *psi = a.psi, *sound = a.sound_speed, *EK = a.EK, *U = a.velocity, *solved = a.solved;
  SLIPFRONT_INDEPENDENT
  for (std::size_t i = 0; i < n; ++i) {
    const double log_s = clamp(psi[i], -668.0, -0.105), from = exp_branch_free(log_s);
    const KandE at(from * from, -2 * log_s);
    sound[i] = at.K;
    EK[i] = at.E;
    U[i] = from;
  }
  SLIPFRONT_INDEPENDENT
  for (std::size_t i = 0; i < n; ++i) {
    const double half = spacing[i] / 2, eighth = momentum[i] / 8, K_from = sound[i], E_from = EK[i], from = U[i];
    const HalleyStep<double> halley(K_from, E_from, from * from, half, eighth);
    const double step = halley.step;
    // K, E and s after the step follow by their derivatives. The error is of the order of the third power of the step.
    const double K = K_from + step * (halley.slope_K + step / 2 * halley.curve_K);
    const double E = E_from + step * (halley.slope_E + step / 2 * halley.curve_E);
    const double s = from + from * (step * (1 + step * (0.5 + step * (1.0 / 6))));
    // Single precision brings the guess this close. A step of third order then leaves an error of a few ulp.
    const bool near = std::fabs(step) * (halley.slope + std::fabs(halley.curve)) < (4e-6 + 5e-7 * K) * halley.slope;
    const bool fine = near && half > 0 && s > least && s < most;
    sound[i] = K;
    EK[i] = E;
    U[i] = s;
    solved[i] = fine ? 1.0 : 0.0;
    s_out[i] = fine ? s : s_out[i];
  }
}

/// Guesses from K m^(1/2) = ln(4 / s) of empty trains, bent towards s = 1, with E between its limits 1 and pi / 2.
SLIPFRONT_CLONES void guess_roughly(const StateArrays& a) {
  constexpr double per_8E = 1 / (8 * 1.2);
  const double *spacing = a.spacing, *momentum = a.momentum;
  double* s = a.s;
  SLIPFRONT_INDEPENDENT
  for (std::size_t i = 0; i < a.size; ++i) {
    const double rapid = momentum[i] * per_8E, half = spacing[i] / 2;
    const double empty = 4 * exp_branch_free(clamp(-half * std::sqrt(1 + rapid * rapid), -668.0, 0.0));
    s[i] = empty / std::sqrt(1 + empty * empty);
  }
}

SLIPFRONT_CLONES void take_logarithms(const StateArrays& a) {
  const double* psi = a.psi;
  double* s = a.s;
  SLIPFRONT_INDEPENDENT
  for (std::size_t i = 0; i < a.size; ++i) s[i] = exp_branch_free(clamp(psi[i], -668.0, -0.105));
}

void solve(const StateArrays& a) {
  approach(a);
  solve_from_logarithm(a);
}

SLIPFRONT_CLONES void find_rapidities(const StateArrays& a) {
  const std::size_t n = a.size;
  const double *spacing = a.spacing, *momentum = a.momentum;
  double *phi = a.phi, *psi = a.psi, *sound = a.sound_speed, *EK = a.EK, *U = a.velocity;
  SLIPFRONT_INDEPENDENT
  for (std::size_t i = 0; i < n; ++i) {
    const double half = spacing[i] / 2, eighth = momentum[i] / 8, K = sound[i], E = EK[i], s = U[i];
    const double m = 1 - s * s, push = half * eighth, forth = std::fabs(push), both = E * K;
    // psi = ln((1 + s) / (1 - s)) / 2. From tanh phi = push / E K and m ((EK)^2 - push^2) = (E half)^2 follows phi =
    // ln(m (EK + forth)^2 / (E half)^2) / 2.
    const double sum = both + forth, steep = m * sum;
    const LogRatio for_psi(1 + s, 1 - s, 2 * s);
    const LogRatio for_phi(steep * sum, (E * half) * (E * half), 2 * steep * forth);
    const double psi_phi = for_psi.below * for_phi.below, inverse = 1 / (both * psi_phi);  // one division, not three
    const double per_both = psi_phi * inverse, per_psi = both * for_phi.below * inverse,
                 per_phi = both * for_psi.below * inverse;
    sound[i] = s * K * K * per_both;
    EK[i] = both;
    U[i] = push * per_both;
    psi[i] = for_psi.half_log(per_psi);
    phi[i] = std::copysign(for_phi.half_log(per_phi), eighth);
  }
}

SLIPFRONT_CLONES void find_slip(const StateArrays& a, double* fastest) {
  const std::size_t n = a.size;
  const double *spacing = a.spacing, *momentum = a.momentum, *K = a.sound_speed, *E = a.EK;
  double* U = a.velocity;
  SLIPFRONT_INDEPENDENT
  for (std::size_t i = 0; i < n; ++i) {
    const double push = spacing[i] * momentum[i] / 16, per_both = 1 / (E[i] * K[i]);
    U[i] = push * per_both;
    fastest[i] = std::fabs(momentum[i]) * (K[i] * per_both) / 4;  // the momentum is 8 sinh phi cosh psi E
  }
}

}  // namespace

// We use several short loops, because a processor can overlap several iterations of a short loop but not of a long one.
void solve_states(const StateArrays& a) {
  solve(a);
  find_rapidities(a);
}

void find_guesses(const StateArrays& a) {
  guess_roughly(a);
  for (int i = 0; i < 2; ++i) {
    approach(a);
    take_logarithms(a);
  }
}

void solve_slip(const StateArrays& a, double* fastest) {
  solve(a);
  find_slip(a, fastest);
}

}  // namespace slipfront::modulation
