#pragma once

#include <cmath>

namespace slipfront::rupture {

/// Root of f between 0 < low < high with f(low) <= 0 <= f(high): bisection in the logarithm down to a factor 4, then
/// secants kept inside the bracket (regula falsi, Illinois variant). Ends at the resolution of a double; needs no
/// derivative and cannot leave.
template <class Function>
double root_in_bracket(double low, double high, Function&& f) {
  while (high > 4 * low) {
    const double middle = std::sqrt(low) * std::sqrt(high);
    (f(middle) < 0 ? low : high) = middle;
  }
  double f_low = f(low), f_high = f(high);
  bool last_below = false;
  const double margin = 2.2e-16 * high;  // the secant lands no nearer to an end: then the other end follows at once
  while (high - low > 2 * margin) {
    // An infinite value would hold the secant at the other end for ever.
    const double part = std::isfinite(f_low - f_high) ? f_low / (f_low - f_high) : 0.5;
    double middle = low + (high - low) * (std::isfinite(part) ? part : 0.5);
    middle = std::fmin(std::fmax(middle, low + margin), high - margin);
    const double value = f(middle);
    if (value == 0) return middle;
    const bool below = value < 0;
    const bool again = below == last_below;  // the other end stays a second time: halve its weight
    last_below = below;
    if (below) {
      low = middle;
      f_low = value;
      if (again) f_high /= 2;
    } else {
      high = middle;
      f_high = value;
      if (again) f_low /= 2;
    }
  }
  return low + (high - low) / 2;
}

}  // namespace slipfront::rupture
