#pragma once

#include <cmath>
#include <functional>

#include "slipfront/theory/modulation/modulation.hpp"

/// How far a field of states is from solving the modulation equations (6) without friction at (x, t), through the
/// production densities and fluxes: k_t + (U k)_x and P_t + Q_x, each over the sum of the sizes of its two terms.
/// Sixth-order central differences.
struct PdeResidual {
  double number;
  double momentum;
};

inline PdeResidual pde_residual(const std::function<slipfront::State(double x, double t)>& state, double x, double t,
                                double dx, double dt) {
  using slipfront::modulation::Pair;
  const auto derivative = [](const std::function<Pair(double)>& f, double h) {
    constexpr double weights[3] = {45.0 / 60, -9.0 / 60, 1.0 / 60};
    Pair sum{0, 0};
    for (int i = 0; i < 3; ++i) {
      const Pair plus = f((i + 1) * h), minus = f(-(i + 1) * h);
      sum.number += weights[i] * (plus.number - minus.number) / h;
      sum.momentum += weights[i] * (plus.momentum - minus.momentum) / h;
    }
    return sum;
  };
  const Pair in_time = derivative([&](double s) { return slipfront::modulation::density(state(x, t + s)); }, dt);
  const Pair in_space = derivative([&](double s) { return slipfront::modulation::flux(state(x + s, t)); }, dx);
  const auto relative = [](double a, double b) { return std::fabs(a + b) / (std::fabs(a) + std::fabs(b)); };
  return {relative(in_time.number, in_space.number), relative(in_time.momentum, in_space.momentum)};
}
