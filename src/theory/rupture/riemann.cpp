#include "slipfront/theory/rupture/riemann.hpp"

#include <cfloat>
#include <cmath>
#include <string>

#include "math/digits.hpp"
#include "math/roots.hpp"
#include "slipfront/error.hpp"
#include "slipfront/math/elliptic.hpp"
#include "slipfront/theory/modulation/modulation.hpp"
#include "theory/modulation/equations.hpp"
#include "theory/rupture/inverse.hpp"

// The 2-wave is the 1-wave of the mirrored problem (x -> -x, phi -> -phi), so this file computes only the 1-wave.

namespace slipfront::rupture {
namespace {

State mirrored(const State& s) { return {-s.phi, s.psi}; }

/// The spacing l and the momentum M of one dislocation. The Lagrangian form of the equations
/// (docs/theory/3_modulation.md 3.4) is l_t = U_q, M_t + p_q = 0 with p = 2 sinh^2 psi. Hence the jump condition
/// between two trains is [p][l] + [U][M] = 0.
struct PerDislocation {
  double spacing_unit;   ///< l cosh(phi) = 2 K / cosh(psi)
  double momentum_unit;  ///< M / sinh(phi) = 8 cosh(psi) E
  double momentum_rest;  ///< momentum_unit - 8, without cancellation; 8 is the mass of an isolated dislocation
};
PerDislocation per_dislocation(double psi) {
  const elliptic::AtPsi at = elliptic::at_psi(psi);
  const double cosh_psi = std::cosh(psi), half = std::sinh(psi / 2);
  return {2 * at.K / cosh_psi, 8 * cosh_psi * at.E, 8 * (2 * half * half * at.E + at.E_rest)};
}

/// The drop of rapidity phi_left - phi_star > 0 across a 1-shock from `left` up to psi_star > psi_left. [p][l] + [U][M]
/// is negative at zero drop and has exactly one zero at a positive drop. This follows from Descartes' rule, because the
/// quartic in exp(phi) has two sign changes.
double shock_drop(const State& left, double psi_star) {
  const PerDislocation a = per_dislocation(left.psi), b = per_dislocation(psi_star);
  // Both products are of the order of psi_star^2, which may underflow. So we divide each factor by psi_star.
  const double jump_p = modulation::pressure_jump(left.psi, psi_star, psi_star);
  const double l_left = a.spacing_unit / std::cosh(left.phi);
  const double jump_unit = (b.momentum_rest - a.momentum_rest) * std::sinh(left.phi);
  const auto mismatch = [&](double drop) {
    const double phi = left.phi - drop;
    const double jump_U = modulation::velocity_jump(left.phi, -drop, psi_star);
    const double jump_sinh = -2 * std::cosh(left.phi - drop / 2) * std::sinh(drop / 2);  // sinh(phi) - sinh(phi_left)
    const double jump_M = (b.momentum_unit * jump_sinh + jump_unit) / psi_star;
    return jump_p * (b.spacing_unit / std::cosh(phi) - l_left) + jump_U * jump_M;
  };
  // For weak shocks the root is psi_star - psi_left, which continues the fan. We widen a bracket around it.
  double low = psi_star - left.psi, high = low;
  while (mismatch(low) > 0 && low > DBL_MIN) low /= 2;
  while (mismatch(high) < 0) {
    high *= 2;
    if (!(high < 1400))
      throw NumericsError("the shock from psi = " + digits(left.psi) + " is too strong for double precision");
  }
  return root_in_bracket(low, high, mismatch);
}

/// phi_left - phi_star along the 1-wave curve, which is a fan (phi + psi constant) below psi_left and a shock above.
double drop_along_curve(const State& left, double psi_star) {
  return psi_star <= left.psi ? psi_star - left.psi : shock_drop(left, psi_star);
}

/// The psi at which the two wave curves meet: phi_left - drop_left = phi_right + drop_right. The drops increase with
/// psi.
double meeting_psi(const State& left, const State& right) {
  const State back = mirrored(right);
  const double closing = left.phi - right.phi;  // > 0 if the trains run into each other
  const auto excess = [&](double psi) { return drop_along_curve(left, psi) + drop_along_curve(back, psi) - closing; };
  double low = std::fmin(left.psi, right.psi), high = std::fmax(left.psi, right.psi);
  if (excess(high) == 0) return high;
  if (excess(low) >= 0) {  // for two fans, both curves are straight lines
    return (left.psi + right.psi + closing) / 2;
  }
  while (excess(high) < 0) {
    low = high;
    high *= 2;
    if (!(high < 700)) throw NumericsError("Riemann problem: the star state is outside the range of double precision");
  }
  return root_in_bracket(low, high, excess);
}

/// Weaker shocks get their asymptotic speed, the mean of the characteristic speeds on both sides. Its error is of the
/// order of the squared strength. The quotient of jumps would have the larger error eps / strength.
constexpr double weak_below = 6e-6;

/// The 1-wave between `left` and `star`.
Wave first_wave(const State& left, const State& star) {
  if (left.empty()) return {};
  if (star.empty()) {  // a fan down to the edge of the empty region, which moves with the last dislocation
    return {Wave::Kind::fan, modulation::characteristic_speeds(left).minus, modulation::velocity(star.phi)};
  }
  if (star.psi == left.psi) {
    const double speed = modulation::characteristic_speeds(left).minus;
    return {Wave::Kind::none, speed, speed};
  }
  if (star.psi < left.psi)
    return {Wave::Kind::fan, modulation::characteristic_speeds(left).minus,
            modulation::characteristic_speeds(star).minus};
  if (star.psi - left.psi < weak_below * left.psi) {
    const double speed =
        (modulation::characteristic_speeds(left).minus + modulation::characteristic_speeds(star).minus) / 2;
    return {Wave::Kind::shock, speed, speed};
  }
  // The speed of the shock is s = U - j / k. The flux j of dislocations through it follows from j [1/k] = -[U].
  const double l_left = per_dislocation(left.psi).spacing_unit / std::cosh(left.phi);
  const double l_star = per_dislocation(star.psi).spacing_unit / std::cosh(star.phi);
  const double slowed = modulation::velocity_jump(star.phi, left.phi - star.phi);
  const double speed = modulation::velocity(left.phi) - slowed * l_left / (l_left - l_star);
  return {Wave::Kind::shock, speed, speed};
}

Wave mirrored(const Wave& w) { return {w.kind, 0 - w.outer, 0 - w.inner}; }  // 0, and not -0, remains 0

/// Squares of larger stresses overflow. A jump between faster trains loses more than half of its digits.
constexpr double most_psi_of_state = 300, most_phi = 18;

void check(const State& state, const char* side) {
  if (!(state.psi >= 0 && state.psi <= most_psi_of_state))
    throw InputError({.key = std::string(side) + " psi",
                      .value = digits(state.psi),
                      .problem = "not a density that the Riemann problem can be solved for",
                      .allowed = "0 <= psi <= " + digits(most_psi_of_state) + ", a stress of up to 2e130"});
  if (!state.empty() && !(std::fabs(state.phi) <= most_phi))
    throw InputError({.key = std::string(side) + " phi",
                      .value = digits(state.phi),
                      .problem = "not a rapidity that the Riemann problem can be solved for",
                      .allowed = "-" + digits(most_phi) + " <= phi <= " + digits(most_phi) +
                                 ", where U = tanh(phi) differs from 1 in a double"});
}

}  // namespace

RiemannSolution solve_riemann(const State& left, const State& right) {
  check(left, "left");
  check(right, "right");
  RiemannSolution s{left, right, {}, {}, {}};
  const bool parted = left.empty() || right.empty() || (left.phi - right.phi) + left.psi + right.psi <= 0;
  if (parted) {
    s.left_wave = first_wave(left, {left.phi + left.psi, 0});
    s.right_wave = mirrored(first_wave(mirrored(right), {-(right.phi - right.psi), 0}));
    return s;
  }
  s.star.psi = left.phi == right.phi && left.psi == right.psi ? left.psi : meeting_psi(left, right);
  // Both curves give phi_star. We take the one with the smaller drop, because it loses fewer digits.
  const double from_left = drop_along_curve(left, s.star.psi),
               from_right = drop_along_curve(mirrored(right), s.star.psi);
  s.star.phi = std::fabs(from_left) <= std::fabs(from_right) ? left.phi - from_left : right.phi + from_right;
  s.left_wave = first_wave(left, s.star);
  s.right_wave = mirrored(first_wave(mirrored(right), mirrored(s.star)));
  return s;
}

Edges edges_of(const RiemannSolution& solution) {
  const Wave &left = solution.left_wave, &right = solution.right_wave;
  if (left.kind == Wave::Kind::none && right.kind == Wave::Kind::none) return {left.outer, right.outer};
  return {left.kind != Wave::Kind::none ? left.outer : right.inner,
          right.kind != Wave::Kind::none ? right.outer : left.inner};
}

State sample(const RiemannSolution& s, double x_over_t) {
  if (s.left_wave.kind != Wave::Kind::none || !s.left.empty()) {
    if (x_over_t <= s.left_wave.outer) return s.left;
    if (x_over_t < s.left_wave.inner) return state_in_left_fan(s.left.phi + s.left.psi, x_over_t);
  }
  if (s.right_wave.kind != Wave::Kind::none || !s.right.empty()) {
    if (x_over_t >= s.right_wave.outer) return s.right;
    if (x_over_t > s.right_wave.inner) return mirrored(state_in_left_fan(s.right.psi - s.right.phi, -x_over_t));
  }
  return s.star;
}

}  // namespace slipfront::rupture
