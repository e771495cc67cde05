#pragma once

#include <cmath>

namespace slipfront::pulse {

/// Value at the right face of the middle cell from five cell averages, the face nearest to d and e: fifth order where
/// smooth, no new extrema at jumps (WENO-Z: Jiang & Shu 1996; Borges et al. 2008). Pass the averages backwards for the
/// left face. Scale invariant: `tiny` only keeps a constant stretch from dividing by zero.
inline double weno5(double a, double b, double c, double d, double e) {
  const double va = (2 * a - 7 * b + 11 * c) / 6, vb = (-b + 5 * c + 2 * d) / 6, vc = (2 * c + 5 * d - e) / 6;
  const auto square = [](double x) { return x * x; };
  const double ia = 13.0 / 12 * square(a - 2 * b + c) + 0.25 * square(a - 4 * b + 3 * c);
  const double ib = 13.0 / 12 * square(b - 2 * c + d) + 0.25 * square(b - d);
  const double ic = 13.0 / 12 * square(c - 2 * d + e) + 0.25 * square(3 * c - 4 * d + e);
  const double tau = std::fabs(ia - ic);
  const double tiny = 1e-30 * (a * a + b * b + c * c + d * d + e * e) + 1e-300;
  const double wa = 0.1 * (1 + square(tau / (ia + tiny)));
  const double wb = 0.6 * (1 + square(tau / (ib + tiny)));
  const double wc = 0.3 * (1 + square(tau / (ic + tiny)));
  return (wa * va + wb * vb + wc * vc) / (wa + wb + wc);
}

}  // namespace slipfront::pulse
