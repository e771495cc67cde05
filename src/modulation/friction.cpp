#include "slipfront/modulation/friction.hpp"

#include <cmath>
#include <numbers>
#include <string>

#include "slipfront/elliptic/complete.hpp"
#include "slipfront/error.hpp"
#include "slipfront/train/train.hpp"

namespace slipfront::modulation {
namespace {

using std::numbers::pi;

/// <sigma^n> over a period: (2 beta)^n / K times the integral of dn^(n-1) over the amplitude from 0 to pi/2. Periodic
/// and smooth in it, so the trapezoidal rule would do for dense trains; towards the empty limit dn^(n-1) becomes
/// cos^(n-1), and the substitution amplitude = gd(y) turns both ends into decaying tails.
double integral_of_power(const elliptic::AtPsi& at, double n) {
  // amplitude = gd(y): cos = sech y, d(amplitude) = sech y dy, dn^2 = sech^2 y + m1 tanh^2 y
  constexpr double end = 40, h = 1.0 / 16;
  double sum = 0;
  for (int i = 0; i * h <= end; ++i) {
    const double y = i * h, sech = 1 / std::cosh(y), tanh = std::tanh(y);
    const double term = sech * std::pow(sech * sech + at.s * at.s * tanh * tanh, (n - 1) / 2);
    sum += i == 0 ? term / 2 : term;
  }
  return sum * h;
}

double mean_power(const State& state, double n) {
  const elliptic::AtPsi at = elliptic::at_psi(state.psi);
  const double two_beta = 2 * std::cosh(state.phi) * std::cosh(state.psi);
  return std::pow(two_beta, n) / at.K * integral_of_power(at, n);
}

}  // namespace

const char* name_of(Closure closure) { return closure == Closure::paper ? "paper" : "consistent"; }

Closure closure_named(std::string_view name) {
  for (const Closure c : {Closure::consistent, Closure::paper})
    if (name == name_of(c)) return c;
  throw InputError(
      {.key = "closure", .value = std::string(name), .problem = "unknown", .allowed = "consistent, paper"});
}

double momentum_loss(const State& state, const Friction& f) {
  if (f.law == FrictionLaw::none || f.coefficient == 0 || state.empty()) return 0;
  const double U = std::tanh(state.phi), sign = (U > 0) - (U < 0);
  switch (f.law) {
    case FrictionLaw::viscous: {
      const train::Averages a = train::averages(state);
      return f.coefficient * (f.closure == Closure::consistent ? a.P : a.k * a.W);  // C <w sigma>, or C k <w>
    }
    case FrictionLaw::coulomb:
      return f.coefficient * sign * train::averages(state).k;  // both closures alike
    case FrictionLaw::power: {
      const double speed = sign * std::pow(std::fabs(U), f.exponent);
      if (f.closure == Closure::consistent) return f.coefficient * speed * mean_power(state, f.exponent + 1);
      return f.coefficient * speed * train::averages(state).k * mean_power(state, f.exponent);
    }
    case FrictionLaw::none:
      break;
  }
  return 0;
}

double relaxation_rate(const State& state, const Friction& f) {
  if (f.coefficient == 0 || state.empty()) return 0;
  if (f.law == FrictionLaw::viscous) {
    if (f.closure == Closure::consistent) return f.coefficient;
    const elliptic::AtPsi at = elliptic::at_psi(state.psi);
    return f.coefficient * pi * pi / (4 * at.E * at.K);  // W / I
  }
  if (f.law != FrictionLaw::power || state.phi == 0) return 0;
  return momentum_loss(state, f) / train::averages(state).P;
}

// From momentum_loss / P with P = U <sigma^2> = U 4 beta^2 E / K and k = pi beta / K.
PowerLawRate::PowerLawRate(const Friction& friction) : friction_(friction) {}

namespace {

constexpr double per_unit = 32, least_log = -700, most_psi = 20;  // nodes per unit of ln psi

}  // namespace

double PowerLawRate::node(std::size_t i) const {
  double& value = nodes_[i];
  if (std::isnan(value)) {
    const elliptic::AtPsi at = elliptic::at_psi(std::exp(least_log + static_cast<double>(i) / per_unit));
    const double n = friction_.exponent;
    value = friction_.closure == Closure::consistent ? integral_of_power(at, n + 1) / at.E
                                                     : pi / 2 * integral_of_power(at, n) / (at.E * at.K);
  }
  return value;
}

/// Lagrange's polynomial through six nodes. Dense trains have sigma = <sigma>, and g = 1.
double PowerLawRate::shape(double psi) const {
  if (psi >= most_psi) return 1;
  if (nodes_.empty())
    nodes_.assign(static_cast<std::size_t>((std::log(most_psi) - least_log) * per_unit) + 8, std::nan(""));
  const double position = (std::log(psi) - least_log) * per_unit;
  const double begin = std::fmax(std::floor(position) - 2, 0.0), s = position - begin;
  const auto first = static_cast<std::size_t>(begin);
  double sum = 0;
  for (std::size_t j = 0; j < 6; ++j) {
    double weight = 1;
    for (std::size_t k = 0; k < 6; ++k)
      if (k != j) weight *= (s - static_cast<double>(k)) / (static_cast<double>(j) - static_cast<double>(k));
    sum += weight * node(first + j);
  }
  return sum;
}

double PowerLawRate::operator()(const State& state) const {
  if (friction_.coefficient == 0 || state.empty() || state.phi == 0) return 0;
  const double fastest = 2 * std::sinh(std::fabs(state.phi)) * std::cosh(state.psi);
  return friction_.coefficient * std::pow(fastest, friction_.exponent - 1) * shape(state.psi);
}

}  // namespace slipfront::modulation
