#include "slipfront/math/elliptic.hpp"

#include <cmath>
#include <numbers>
#include <string>

#include "math/digits.hpp"
#include "slipfront/error.hpp"

namespace slipfront::elliptic {
namespace {

using std::numbers::pi;
constexpr double ln4 = 1.38629436111989061883;

/// Below this complementary modulus the logarithmic series needs 9 terms; above it the mean needs 5 steps.
constexpr double series_below = 0.125;

/// DLMF 19.12.1-2, the expansion in m1 about m = 1. Every term is positive, so nothing cancels:
///   K = sum a_n m1^n (L - d_n)          a_n = ((1/2)_n / n!)^2,  d_n = 2 sum_{j<=n} 1/((2j-1) 2j)
///   E = 1 + sum b_n m1^(n+1) (L - e_n)  b_n = a_n (2n+1)/(2n+2), e_n = d_n + 1/((2n+1)(2n+2))
/// with L = ln(4 / sqrt(m1)).
struct Series {
  double K;
  double E_rest;  ///< E - 1
};
Series log_series(double m1, double L) {
  double a = 1.0, d = 0.0, power = 1.0, K = 0.0, E = 0.0;
  for (int n = 0; n < 9; ++n) {
    const double odd = 2 * n + 1, even = 2 * n + 2;
    K += a * power * (L - d);
    E += a * (odd / even) * power * (L - d - 1 / (odd * even));
    d += 2 / (odd * even);
    a *= (odd / even) * (odd / even);
    power *= m1;
  }
  return {K, m1 * E};
}

/// The arithmetic-geometric mean of 1 and s, with its differences c_n = (a_n - b_n) / 2 (Abramowitz & Stegun 17.6).
/// c1 = (1 - s) / 2 comes from the caller, who knows it without cancellation.
struct Mean {
  double limit;   ///< agm(1, s) = pi / (2 K)
  double excess;  ///< E/K - s = c1^2 - 2 c2^2 - 4 c3^2 - ...
};
Mean mean(double s, double c1) {
  double a = (1 + s) / 2, b = std::sqrt(s), c = c1, tail = 0, weight = 2;
  for (int n = 2; n <= 5; ++n) {
    const double next = (a + b) / 2;
    c = c * c / (4 * next);  // (a - b) / 2, without the difference
    tail += weight * c * c;
    weight *= 2;
    b = std::sqrt(a * b);
    a = next;
  }
  return {(a + b) / 2, c1 * c1 - tail};
}

/// The fields of AtPsi from s = sqrt(m1) and c1 = (1 - s)/2.
AtPsi assemble(double s, double c1) {
  const double m1 = s * s;
  if (s < series_below) {
    const Series c = log_series(m1, ln4 - std::log(s));
    const double E = 1 + c.E_rest, ratio = E / c.K;
    return {c.K, E, s, ratio, ratio - s, 1 - ratio, ratio - m1, c.E_rest};
  }
  const Mean agm = mean(s, c1);
  const double ratio = s + agm.excess;
  const double K = pi / (2 * agm.limit);
  return {K, K * ratio, s, ratio, agm.excess, 2 * c1 - agm.excess, agm.excess + 2 * s * c1, K * ratio - 1};
}

}  // namespace

Complete complete(double m1) {
  if (!(m1 > 0 && m1 <= 1))
    throw InputError(
        {.key = "m1", .value = digits(m1), .problem = "not a complementary parameter", .allowed = "0 < m1 <= 1"});
  const double s = std::sqrt(m1);
  const AtPsi at = assemble(s, (1 - m1) / (2 * (1 + s)));
  return {at.K, at.E};
}

AtPsi at_psi_empty(double psi) {
  const double K = ln4 - std::log(psi), ratio = 1 / K;
  return {K, 1.0, psi, ratio, ratio - psi, 1 - ratio, ratio, psi * (psi * (K - 0.5) / 2)};
}

AtPsi at_psi_dense(double psi) {
  const double c1 = std::exp(-2 * psi);  // m = 4 c1
  return {pi / 2, pi / 2, 1.0, 1.0, c1 * c1, 2 * c1, 2 * c1, pi / 2 - 1};
}

AtPsi at_modulus(double s) { return s < psi_empty_below ? at_psi_empty(s) : assemble(s, (1 - s) / 2); }

AtPsi at_psi(double psi) {
  if (!(psi > 0))
    throw InputError({.key = "psi", .value = digits(psi), .problem = "not a positive number", .allowed = "psi > 0"});
  if (psi < psi_empty_below) return at_psi_empty(psi);
  if (psi > psi_dense_above) return at_psi_dense(psi);
  const double e = std::expm1(2 * psi);
  return assemble(e / (e + 2), 1 / (e + 2));
}

namespace {

using std::numbers::pi;

struct Triple {
  double sn, cn, dn;
};

/// Asymptotic regime s = sqrt(m1) -> 0 for 0 <= v <= K/2 (Abramowitz & Stegun 16.15); the next term is of order s^2.
Triple nearly_hyperbolic(double v, double s) {
  const double sinh = std::sinh(v), cosh = std::cosh(v);
  const double sech = 1 / cosh, tanh = sinh * sech;
  const double quarter = s * s / 4;
  const double less = quarter * (sinh * cosh - v), more = quarter * (sinh * cosh + v);
  return {tanh + less * sech * sech, sech * (1 - less * tanh), sech * (1 + more * tanh)};
}
constexpr double hyperbolic_below = 1e-8;

/// Descending Landen transformation on the complementary side (Bulirsch, Numer. Math. 7, 78, 1965).
Triple descending_landen(double v, double s) {
  constexpr int most = 8;  // quadratic convergence: s = 1e-8 needs 6
  constexpr double near = 1e-9;
  double a_n[most], b_n[most];
  double a = 1, b = s, c = 1;
  int last = 0;
  for (int n = 0; n < most; ++n) {
    a_n[n] = a;
    b_n[n] = b;
    last = n;
    c = (a + b) / 2;
    if (a - b <= near * a) break;
    b = std::sqrt(a * b);
    a = c;
  }
  const double angle = c * v;
  double sn = std::sin(angle), cn = std::cos(angle), dn = 1;
  if (sn == 0) return {sn, cn, dn};
  double cot = cn / sn;
  c *= cot;
  for (int n = last; n >= 0; --n) {
    cot *= c;
    c *= dn;
    dn = (b_n[n] + cot) / (a_n[n] + cot);
    cot = c / a_n[n];
  }
  sn = 1 / std::sqrt(c * c + 1);
  return {sn, c * sn, dn};
}

Triple first_half(double v, double s) {
  if (v == 0) return {0, 1, 1};
  return s < hyperbolic_below ? nearly_hyperbolic(v, s) : descending_landen(v, s);
}

Jacobi evaluate(double z, double s, double K) {
  if (!std::isfinite(z))
    throw InputError({.key = "z", .value = digits(z), .problem = "not finite", .allowed = "a finite argument"});
  const double n = std::nearbyint(z / (2 * K));  // am(z + 2K) = am(z) + pi
  const double rest = std::fma(-2 * K, n, z);
  const double v = std::fabs(rest);
  Triple f{};
  if (v <= K / 2) {
    f = first_half(v, s);
  } else {  // functions of K - v: the small ones become products with s and stay precise
    const Triple g = first_half(std::fmax(K - v, 0.0), s);
    f = {g.cn / g.dn, s * g.sn / g.dn, s / g.dn};
  }
  const double side = rest < 0 ? -1.0 : 1.0;
  const double flip = std::fmod(n, 2.0) == 0 ? 1.0 : -1.0;
  // pi/2 - am: for rest > 0 the small angle between cn and sn itself, for rest < 0 its supplement.
  const double am = n * pi + side * std::atan2(f.sn, f.cn);
  const double coamplitude = (rest < 0 ? pi - std::atan2(f.cn, f.sn) : std::atan2(f.cn, f.sn)) - n * pi;
  return {am, coamplitude, flip * side * f.sn, flip * f.cn, f.dn};
}

}  // namespace

Jacobi jacobi(double z, double m1) { return evaluate(z, std::sqrt(m1), complete(m1).K); }

Jacobi jacobi(double z, const AtPsi& at) { return evaluate(z, at.s, at.K); }

}  // namespace slipfront::elliptic
