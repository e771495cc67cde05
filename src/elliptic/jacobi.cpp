#include "slipfront/elliptic/jacobi.hpp"

#include <cmath>
#include <numbers>
#include <string>

#include "foundation/text/digits.hpp"
#include "slipfront/error.hpp"

namespace slipfront::elliptic {
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
