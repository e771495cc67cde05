#pragma once

namespace slipfront {

/// slope x + curve x^2, from 0 at x = 0.
struct Parabola {
  double slope, curve;
};

/// The one that rises by `rise_a` to x = a and by `rise_b` to x = b.
inline Parabola parabola_through(double a, double rise_a, double b, double rise_b) {
  const double fa = rise_a / a, fb = rise_b / b, curve = (fb - fa) / (b - a);
  return {fa - curve * a, curve};
}

}  // namespace slipfront
