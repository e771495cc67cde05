#include "slipfront/theory/train.hpp"

#include <cmath>
#include <initializer_list>
#include <numbers>

#include "math/roots.hpp"
#include "slipfront/math/elliptic.hpp"

namespace slipfront::train {
namespace {

using std::numbers::pi;

/// beta = [m (1 - U^2)]^(-1/2), the inverse width of a dislocation.
double beta_of(const State& state) { return std::cosh(state.phi) * std::cosh(state.psi); }

}  // namespace

Fields fields(const State& state, double xi) {
  const elliptic::AtPsi at = elliptic::at_psi(state.psi);
  const double beta = beta_of(state);
  const elliptic::Jacobi f = elliptic::jacobi(beta * xi, at);
  const double u = 2 * f.coamplitude;    // Eq. (4): u = pi - 2 am(beta xi)
  const double sigma = 2 * beta * f.dn;  // -u_x
  const double w = std::tanh(state.phi) * sigma;
  return {u, sigma, w};
}

double spacing(const State& state) { return 2 * elliptic::at_psi(state.psi).K / beta_of(state); }

namespace {

double one_minus_cos(double cosh_psi, const elliptic::AtPsi& at) {
  return 2 * cosh_psi * cosh_psi * at.above_m1;  // (2 / m)(E/K - m1)
}

}  // namespace

double one_minus_cos(double psi) { return psi == 0 ? 0 : one_minus_cos(std::cosh(psi), elliptic::at_psi(psi)); }

Averages averages(const State& state) {
  const double sinh_phi = std::sinh(state.phi), cosh_phi = std::cosh(state.phi);
  Averages a{};
  if (state.empty()) {
    a.J = 4 / pi * cosh_phi;
    return a;
  }
  const elliptic::AtPsi at = elliptic::at_psi(state.psi);
  const double cosh_psi = std::cosh(state.psi), sinh_psi = std::sinh(state.psi);
  const double beta = cosh_phi * cosh_psi, U = std::tanh(state.phi);

  a.k = pi * beta / at.K;                                             // Eq. (5): k = pi beta / K
  a.W = pi * sinh_phi * cosh_psi / at.K;                              // W = U k
  a.sigma2 = 4 * beta * beta * at.ratio;                              // 4 beta^2 E / K
  a.sigma3 = 2 * pi * beta * beta * beta * (1 + at.s * at.s) / at.K;  // (2 beta)^3 pi (2 - m) / (4 K)
  a.one_minus_cos = one_minus_cos(cosh_psi, at);
  a.P = U * a.sigma2;
  a.Q = U * a.P + 2 * sinh_psi * sinh_psi;  // (1 + U^2)/2 <sigma^2> - <1 - cos u> without cancellation
  a.H = (1 + U * U) / 2 * a.sigma2 + a.one_minus_cos;
  a.I = 4 / pi * sinh_phi * cosh_psi * at.E;  // P / k
  a.J = 4 / pi * beta * at.E;
  return a;
}

Averages averages(const State& state, double a) {
  Averages v = averages(state);
  for (double* first : {&v.k, &v.W, &v.I, &v.J}) *first *= a;
  for (double* second : {&v.sigma2, &v.P, &v.Q, &v.H}) *second *= a * a;
  v.sigma3 *= a * a * a;
  return v;  // <1 - cos u> does not depend on the units
}

double stress_at_rest(double psi) { return pi * std::cosh(psi) / elliptic::at_psi(psi).K; }

using std::numbers::pi;

double psi_of_stress(double stress) {
  // Newton's method starts from the limit of a sparse or a dense train. For small stress, K = ln(4/psi) = pi/Sigma. For
  // large stress, K = pi/2 and Sigma = 2 cosh(psi).
  if (stress > 20) {
    const auto dense = [stress](double psi) {
      const elliptic::AtPsi at = elliptic::at_psi(psi);
      return Residual{std::log(pi * std::cosh(psi) / at.K / stress),
                      psi * (std::tanh(psi) - elliptic::log_slope_of_K(at))};
    };
    const double guess = std::log(stress);
    if (guess > elliptic::psi_dense_above + 1) return guess;  // Sigma = 2 cosh(psi) = exp(psi) up to rounding
    return newton_in_log(guess, dense, "psi of a stress");
  }
  const auto residual = [stress](double psi) {  // K - pi cosh(psi) / Sigma, linear in ln(psi) for small psi
    const elliptic::AtPsi at = elliptic::at_psi(psi);
    return Residual{at.K - pi * std::cosh(psi) / stress,
                    psi * (elliptic::log_slope_of_K(at) * at.K - pi * std::sinh(psi) / stress)};
  };
  const double bare = 4 * std::exp(-pi / stress);
  return newton_in_log(stress < 1 ? bare : std::log1p(bare), residual, "psi of a stress");
}

}  // namespace slipfront::train
