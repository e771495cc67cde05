#pragma once

#include <cmath>
#include <functional>
#include <numbers>

#include "slipfront/lattice/chain/chain.hpp"

/// Exact solutions of u_tt - u_xx + sin u = 0, and chains that start from them.
namespace exact {

using Solution = std::function<double(double x, double t)>;

inline Solution kink(double U) {
  const double g = 1 / std::sqrt(1 - U * U);
  return [=](double x, double t) { return 4 * std::atan(std::exp(-g * (x - U * t))); };
}
inline Solution breather(double frequency) {
  const double w = frequency, q = std::sqrt(1 - w * w);
  return [=](double x, double t) { return 4 * std::atan(q / w * std::sin(w * t) / std::cosh(q * x)); };
}
/// Two dislocations that meet (and part again) at t = 0, x = 0.
inline Solution kink_kink(double U) {
  const double g = 1 / std::sqrt(1 - U * U);
  return [=](double x, double t) { return -4 * std::atan(U * std::sinh(g * x) / std::cosh(g * U * t)); };
}
/// A dislocation and an antidislocation that pass through each other at t = 0.
inline Solution kink_antikink(double U) {
  const double g = 1 / std::sqrt(1 - U * U);
  return [=](double x, double t) { return 4 * std::atan(std::sinh(g * U * t) / (U * std::cosh(g * x))); };
}

inline slipfront::chain::Motion motion_of(const Solution& u, const slipfront::chain::Grid& grid, double t) {
  slipfront::chain::Motion m;
  const double d = 1e-3;  // sixth-order central difference
  for (std::size_t j = 0; j < grid.sites; ++j) {
    const double x = grid.x(j);
    m.u.push_back(u(x, t));
    m.velocity.push_back((45 * (u(x, t + d) - u(x, t - d)) - 9 * (u(x, t + 2 * d) - u(x, t - 2 * d)) + u(x, t + 3 * d) -
                          u(x, t - 3 * d)) /
                         (60 * d));
  }
  return m;
}

/// Largest difference of a chain from the solution, which it followed from `from`.
inline double error(const slipfront::chain::Chain& chain, const Solution& u, double from) {
  const auto w = chain.window(0, chain.problem().grid.sites);
  double most = 0;
  for (std::size_t j = 0; j < w.u.size(); ++j)
    most = std::fmax(most, std::fabs(w.u[j] - u(w.x[j], from + chain.time())));
  return most;
}

}  // namespace exact
