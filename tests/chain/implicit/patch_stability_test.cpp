// Steady sliding of a chain with a patch that weakens with velocity, between ends that strengthen.

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <vector>

#include "loaded_chains.hpp"

namespace {

using namespace slipfront;
using namespace loaded;
using chain::ImplicitChain;

/// The rate s of a sum of y_k = exp(s t_k) cos(omega t_k + phase), by least squares in y_k+1 = p y_k - q y_k-1.
double rate_of(const std::vector<double>& y, double interval) {
  double xx = 0, xz = 0, zz = 0, xy = 0, zy = 0;
  for (std::size_t k = 1; k + 1 < y.size(); ++k) {
    const double x = y[k], z = -y[k - 1];
    xx += x * x;
    xz += x * z;
    zz += z * z;
    xy += x * y[k + 1];
    zy += z * y[k + 1];
  }
  const double q = (xx * zy - xz * xy) / (xx * zz - xz * xz);
  return std::log(q) / (2 * interval);
}

/// The rate at which a small disturbance in the middle grows, with this number of weakening sites there.
double growth_of_patch(std::size_t patch) {
  constexpr std::size_t sites = 80;
  constexpr double spacing = 2, v = 0.001, f0 = 0.05, a = 0.01, D = 1, w0 = 0.01, outside = 0.005, inside = 0.018;
  const double first = spacing * (static_cast<double>(sites - patch) / 2 - 0.5), last = spacing * (sites - 1) - first;
  const auto b = [=](double x) { return x > first && x < last ? inside : outside; };
  Problem p = smooth_block();
  p.model = chain::Model::lattice;
  p.grid = {0, spacing, sites};
  p.friction = rate_and_state(f0, a, inside, D, w0, D / v)
                   .with("evolution_effect", {[b](double x, double) { return b(x); }, outside, inside});
  p.loading = {.stiffness = 0.001, .velocity = v};
  p.forcing = [b](double x, double) {
    return a * std::asinh(v / (2 * w0) * std::exp((f0 + b(x) * std::log(w0 / v)) / a));
  };
  p.steady_forcing = true;
  p.tolerance = 1e-8 * v;
  Motion start = at_rest(p);
  for (std::size_t j = 0; j < sites; ++j) {
    const double x = (p.grid.x(j) - spacing * (sites - 1) / 2) / 20;
    start.velocity.push_back(v * (1 + 1e-4 * std::exp(-x * x)));
  }
  ImplicitChain chain(p, start);
  std::vector<double> deviation;
  constexpr double interval = 1000, from = 15e3, end = 45e3;
  for (double t = from; t <= end; t += interval) {
    chain.advance_to(t);
    const chain::Window now = chain.window(sites / 2, sites / 2 + 1);
    deviation.push_back(now.velocity[0] - v);
  }
  return rate_of(deviation, interval);
}

/// The patch grows from 14 sites on, by the eigenvalues that tests/reference/patch_stability.py prints.
TEST(PatchStability, GrowthRateIsThatOfTheEigenvalues) {
  EXPECT_NEAR(growth_of_patch(12) / -3.23842415e-05, 1, 0.01);
  EXPECT_NEAR(growth_of_patch(16) / 7.52717392e-05, 1, 0.01);
  EXPECT_NEAR(growth_of_patch(20) / 1.44621812e-04, 1, 0.01);
}

}  // namespace
