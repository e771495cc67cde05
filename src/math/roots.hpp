#pragma once
/// \file
/// Roots of functions of one variable: by secants in a bracket, by halving, and by Newton's method.

#include <cmath>
#include <string>

#include "slipfront/error.hpp"

namespace slipfront {

/// An interval that contains the root of a rising function, narrowed by secants. A secant that moves the same end twice
/// gives the other end half its weight (regula falsi, Illinois variant), so that both ends converge. The caller
/// evaluates the function at `x`, maybe for many brackets at once, and ends when the root is as close as it needs:
///
///     for (root.aim(); !done; root.aim()) root.take(f(root.x));
struct Bracket {
  double low, high;
  double at_low = 0, at_high = 0;  ///< the function at the ends, perhaps halved: at_low < 0 < at_high
  double x = 0;
  int side = 0;  ///< the end that moved last: -1 low, 1 high, 0 neither

  /// Moves one end to x. `at` is the function at x, and its sign selects the end.
  void take(double at) {
    const int now = at > 0 ? 1 : -1;
    (at > 0 ? high : low) = x;
    (at > 0 ? at_high : at_low) = at;
    if (side == now) (at > 0 ? at_low : at_high) /= 2;
    side = now;
  }
  /// Chooses x by a secant from the end nearer to the root. If the function is infinite at an end, x is the middle,
  /// because a secant would stay at the other end for ever. With a `margin`, x is at least this far from both ends, so
  /// that the other end follows at once.
  void aim(double margin = 0) {
    const double rise = at_high - at_low;
    if (!std::isfinite(rise))
      x = (low + high) / 2;
    else
      x = -at_low < at_high ? low - (high - low) * (at_low / rise) : high - (high - low) * (at_high / rise);
    if (margin > 0) x = std::fmin(std::fmax(x, low + margin), high - margin);
    keep_inside();
  }
  void keep_inside() {
    if (!(x > low && x < high)) x = (low + high) / 2;
  }
};

/// Finds the root of a rising f in a bracket whose ends are evaluated, from its x, or by a secant if x is not inside.
/// Ends if |f| is at most `least`, or the bracket is narrower than `precision` times the larger of |x| and `scale`.
template <class Function>
double root_of(Bracket root, double least, double precision, double scale, const Function& f) {
  constexpr int most_steps = 200;
  if (!(root.x > root.low && root.x < root.high)) root.aim();
  for (int i = 0; i < most_steps; ++i, root.aim()) {
    if (root.high - root.low <= precision * std::fmax(scale, std::fmax(std::fabs(root.low), std::fabs(root.high))))
      break;
    const double at = f(root.x);
    if (std::fabs(at) <= least) break;
    root.take(at);
  }
  return root.x;
}

/// A point at which a condition holds, and one at which it does not.
struct Ends {
  double holding, failing;
};

/// Halves the distance of both points `halvings` times. 60 leave no number between them, unless they enclose 0.
template <class Condition>
Ends bisected(Ends ends, const Condition& holds, int halvings = 60) {
  for (int i = 0; i < halvings; ++i) {
    const double middle = (ends.holding + ends.failing) / 2;
    (holds(middle) ? ends.holding : ends.failing) = middle;
  }
  return ends;
}

/// Finds the root of a rising f between 0 < low < high, where f(low) <= 0 <= f(high). It bisects the logarithm until
/// high <= 4 low, then takes secants down to the resolution of a double.
template <class Function>
double root_in_bracket(double low, double high, Function&& f) {
  while (high > 4 * low) {
    const double middle = std::sqrt(low) * std::sqrt(high);
    (f(middle) < 0 ? low : high) = middle;
  }
  Bracket root{.low = low, .high = high, .at_low = f(low), .at_high = f(high)};
  const double margin = 2.2e-16 * high;
  while (root.high - root.low > 2 * margin) {
    root.aim(margin);
    const double value = f(root.x);
    if (value == 0) return root.x;
    root.take(value);
  }
  return root.low + (root.high - root.low) / 2;
}

/// A residual and its derivative with respect to ln x.
struct Residual {
  double value;
  double slope;
};

/// Root x > 0 of a monotone function by Newton's method in ln x; the last correction is relative, so that x keeps full
/// precision at 1e-300 as at 1. Steps are limited to a factor e^2.
template <class Function>
double newton_in_log(double x, Function&& function, const char* what) {
  for (int iteration = 0; iteration < 60; ++iteration) {
    const Residual r = function(x);
    const double step = std::fmin(std::fmax(-r.value / r.slope, -2.0), 2.0);
    if (!std::isfinite(step)) break;
    x *= std::fabs(step) < 0.1 ? 1 + std::expm1(step) : std::exp(step);
    if (std::fabs(step) < 1e-8) return x;  // quadratic: the error left is of the order of step^2
  }
  throw NumericsError(std::string("no convergence for ") + what);
}

/// Root of a monotone function between `low` and `high`, by Newton's method, which bisects where a step would leave the
/// bracket. `function` returns a pair of value and slope; it rises or falls. The result has an error of about 1e-13,
/// relative above 1.
template <class Function>
double bracketed_newton(double low, double high, double guess, bool rising, Function&& function) {
  double x = guess;
  for (int i = 0; i < 60; ++i) {
    const auto [value, slope] = function(x);
    if (std::fabs(value) < 1e-12) break;
    ((value > 0) == rising ? high : low) = x;
    const double next = x - value / slope;
    const bool inside = next > low && next < high;
    const double step = (inside ? next : low + (high - low) / 2) - x;
    x += step;
    if (std::fabs(step) < (inside ? 1e-7 : 1e-13) * (1 + std::fabs(x))) break;  // quadratic: the error is step^2
  }
  return x;
}

}  // namespace slipfront
