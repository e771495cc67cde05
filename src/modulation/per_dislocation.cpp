#include "slipfront/modulation/per_dislocation.hpp"

#include <cmath>
#include <string>

#include "slipfront/elliptic/complete.hpp"
#include "slipfront/error.hpp"

namespace slipfront::modulation {
namespace {

/// Beyond this half spacing K = ln(4/psi) leaves the range of psi.
constexpr double most_half_spacing = 700;

[[noreturn]] void give_up(const Carried& c) {
  throw NumericsError("no state has the spacing " + std::to_string(c.spacing) + " and the momentum " +
                      std::to_string(c.momentum) + " per dislocation");
}

}  // namespace

Carried carried(const State& state) {
  const elliptic::AtPsi at = elliptic::at_psi(state.psi);
  const double cosh_psi = std::cosh(state.psi);
  return {2 * at.K / (std::cosh(state.phi) * cosh_psi), 8 * std::sinh(state.phi) * cosh_psi * at.E};
}

State state_of(const Carried& c, double psi_guess) {
  if (!(c.spacing > 0) || !std::isfinite(c.spacing) || !std::isfinite(c.momentum)) give_up(c);
  const double half = c.spacing / 2;
  double psi = psi_guess > 0 && std::isfinite(psi_guess) ? psi_guess : 1;
  for (int iteration = 0; iteration < 80; ++iteration) {
    const elliptic::AtPsi at = elliptic::at_psi(psi);
    // cosh^2 = 1 / (1 - s^2), and 1 - s^2 = 2 (deficit - ...) would cancel: cosh itself is as cheap.
    const double cosh_psi = std::cosh(psi), cosh_square = cosh_psi * cosh_psi;
    const double rapid = c.momentum / (8 * at.E), rapid_square = rapid * rapid;
    const double length = half * std::sqrt(cosh_square + rapid_square);
    // K - length, linear in ln psi where psi is small; its derivative by ln psi.
    const double slope_K = -at.above_m1 / at.s * at.K;
    const double slope_length = half * half / length * at.s * (cosh_square - rapid_square * (1 / at.ratio - 1));
    const double step = -(at.K - length) / (psi * (slope_K - slope_length));
    if (!std::isfinite(step)) give_up(c);
    const double limited = std::fmin(std::fmax(step, -40.0), 2.0);
    if (std::log(psi) + limited < -most_half_spacing) return {std::asinh(c.momentum / 8), 0};
    psi *= std::fabs(limited) < 0.1 ? 1 + std::expm1(limited) : std::exp(limited);
    if (psi > most_half_spacing) give_up(c);
    if (std::fabs(step) < 1e-8) {
      const elliptic::AtPsi last = elliptic::at_psi(psi);
      return {std::asinh(c.momentum / (8 * std::cosh(psi) * last.E)), psi};
    }
  }
  give_up(c);
}

double pressure(double psi) {
  const double sinh_psi = std::sinh(psi);
  return 2 * sinh_psi * sinh_psi;
}

}  // namespace slipfront::modulation
