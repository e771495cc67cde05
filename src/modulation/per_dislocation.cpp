#include "slipfront/modulation/per_dislocation.hpp"

#include <cmath>
#include <string>

#include "slipfront/elliptic/complete.hpp"
#include "slipfront/error.hpp"

namespace slipfront::modulation {
namespace {

/// Range of psi that a double and its functions hold.
constexpr double psi_least = 1e-303, psi_most = 700;

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

Resolved resolve(const Carried& c, double psi_guess) {
  if (!(c.spacing > 0) || !std::isfinite(c.spacing) || !std::isfinite(c.momentum)) give_up(c);
  const double half = c.spacing / 2;
  double psi = psi_guess > 0 && std::isfinite(psi_guess) ? psi_guess : 1;
  for (int iteration = 0; iteration < 80; ++iteration) {
    const elliptic::AtPsi at = elliptic::at_psi(psi);
    const double cosh_psi = std::cosh(psi), cosh_square = cosh_psi * cosh_psi;
    const double rapid = c.momentum / (8 * at.E), rapid_square = rapid * rapid;
    const double length = half * std::sqrt(cosh_square + rapid_square);
    // K - length, linear in ln psi where psi is small; its derivative by ln psi.
    const double slope_K = -at.above_m1 / at.s * at.K;
    const double slope_length = half * half / length * at.s * (cosh_square - rapid_square * (1 / at.ratio - 1));
    const double step = (at.K - length) / (psi * (slope_length - slope_K));
    if (!std::isfinite(step)) give_up(c);
    const double limited = std::fmin(std::fmax(step, -40.0), 2.0);
    if (limited == -40.0 && psi < psi_least) return {{std::asinh(c.momentum / 8), 0}, 0, 0};
    const double before = psi;
    psi *= std::fabs(limited) < 0.1 ? 1 + std::expm1(limited) : std::exp(limited);
    if (psi < psi_least) return {{std::asinh(c.momentum / 8), 0}, 0, 0};
    if (psi > psi_most) give_up(c);
    if (std::fabs(step) < 1e-8) {
      // To the last step by derivatives; what is left is of the order of its square.
      const double last = psi - before, c0 = at.s / at.ratio;
      const double E = at.E + at.s * (at.K - at.E) * last;
      const double sound = c0 * (1 + at.deficit * at.above_m1 / (at.s * at.ratio) * last);
      const double EK = E * (at.K + slope_K * last);
      return {{std::asinh(c.momentum / (8 * std::cosh(psi) * E)), psi}, sound, EK};
    }
  }
  give_up(c);
}

State state_of(const Carried& carried, double psi_guess) { return resolve(carried, psi_guess).state; }

double pressure(double psi) {
  const double sinh_psi = std::sinh(psi);
  return 2 * sinh_psi * sinh_psi;
}

}  // namespace slipfront::modulation
