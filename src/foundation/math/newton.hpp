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

}  // namespace slipfront
