#include "slipfront/theory/modulation/modulation.hpp"

#include <cmath>
#include <string>

#include "math/digits.hpp"
#include "slipfront/error.hpp"
#include "slipfront/math/elliptic.hpp"
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

}  // namespace slipfront::modulation
