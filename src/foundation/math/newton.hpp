#pragma once

#include <cmath>
#include <string>

#include "slipfront/error.hpp"

namespace slipfront {

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
