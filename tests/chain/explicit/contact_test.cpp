// Explicit chains with a contact profile: the polynomial of their force, and their order against another method.
#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

#include "exact_chains.hpp"
#include "lattice/chain/explicit/explicit_chain.hpp"
#include "lattice/chain/explicit/levels/kernel.hpp"

namespace {

using namespace slipfront;
using namespace slipfront::chain;

constexpr double turn = 2 * std::numbers::pi;

/// Strengths up to the limit of check(Problem) at the default spacing, and sites whose u is spread over some turns.
struct Sites {
  static constexpr std::size_t count = 64 * lanes;
  double eps = default_spacing * default_spacing / 12, most = std::pow(least_sites_per_width * default_spacing, -2);
  ContactForce force = contact_force(eps, most);
  std::vector<double> a2, z, S;

  Sites() {
    for (std::size_t j = 0; j < count; ++j) {
      a2.push_back(most * static_cast<double>(j % 23) / 22);
      const double u = 3.1 * std::sin(static_cast<double>(j));
      S.push_back(a2[j] * std::sin(turn * u) / turn);
      z.push_back(u + eps * S[j]);
    }
  }
};

/// We compute z from u, so the test solves no equation either.
TEST(ChainContact, ForceFollowsFromZ) {
  const Sites sites;
  LevelRule rule;
  rule.coupled = 1;  // y = z - S
  std::vector<double> next(Sites::count), y(Sites::count), coefficients(PeriodicForce::terms * Sites::count);
  contact_coefficients(sites.force, sites.a2.data(), coefficients.data(), 0, Sites::count);
  local_part_with_coefficients(rule, coefficients.data(), sites.z.data(), next.data(), next.data(), y.data(), 0,
                               Sites::count);
  for (std::size_t j = 0; j < Sites::count; ++j)
    EXPECT_NEAR(sites.z[j] - y[j], sites.S[j], 1e-7 * sites.a2[j] / turn) << "a^2 = " << sites.a2[j];
}

double contact_at(double x) { return 1 + 0.3 * std::sin(0.7 * x); }

/// u at time t of free-ended sites h apart: differences of sixth order, and the method of Runge and Kutta.
std::vector<double> by_runge_kutta(const Motion& start, const Grid& grid, double time, long steps) {
  const double dt = time / static_cast<double>(steps), h2 = grid.spacing * grid.spacing;
  const long n = static_cast<long>(grid.sites);
  using Field = std::vector<double>;
  const auto force = [&](const Field& u) {
    Field f(u.size());
    const auto at = [&](long j) { return u[static_cast<std::size_t>(j < 0 ? -j : j >= n ? 2 * (n - 1) - j : j)]; };
    for (long j = 0; j < n; ++j) {
      const double bend = 1.5 * (at(j - 1) + at(j + 1)) - 0.15 * (at(j - 2) + at(j + 2)) +
                          (at(j - 3) + at(j + 3)) / 90 - 49.0 / 18 * at(j);
      const double a = contact_at(grid.x(static_cast<std::size_t>(j)));
      f[static_cast<std::size_t>(j)] = bend / h2 - a * a * std::sin(at(j));
    }
    return f;
  };
  const auto moved = [](const Field& u, double by, const Field& v) {
    Field sum(u);
    for (std::size_t j = 0; j < u.size(); ++j) sum[j] += by * v[j];
    return sum;
  };
  Field u = start.u, v = start.velocity;
  for (long k = 0; k < steps; ++k) {
    const Field a1 = force(u), v2 = moved(v, dt / 2, a1), a2 = force(moved(u, dt / 2, v)), v3 = moved(v, dt / 2, a2),
                a3 = force(moved(u, dt / 2, v2)), v4 = moved(v, dt, a3), a4 = force(moved(u, dt, v3));
    for (std::size_t j = 0; j < u.size(); ++j) {
      u[j] += dt / 6 * (v[j] + 2 * v2[j] + 2 * v3[j] + v4[j]);
      v[j] += dt / 6 * (a1[j] + 2 * a2[j] + 2 * a3[j] + a4[j]);
    }
  }
  return u;
}

/// A kink crosses two periods of the contact profile, with 32 levels of a tile at a time.
TEST(ChainContact, ConvergesAtFourthOrder) {
  const auto motion = [](double h) {
    Problem p;
    p.grid = {-20, h, static_cast<std::size_t>(std::lround(40 / h)) + 1};
    p.contact = contact_at;
    return std::pair{p, exact::motion_of(exact::kink(0.5), p.grid, -16)};
  };
  constexpr double time = 16;
  const auto [fine, fine_start] = motion(0.05);
  const std::vector<double> reference = by_runge_kutta(fine_start, fine.grid, time, 800);
  double last = 0;
  for (const std::size_t step : {4u, 2u}) {
    const auto [p, start] = motion(0.05 * static_cast<double>(step));
    ExplicitChain chain(p, start);
    chain.advance_to(time);
    const Window window = chain.window(0, p.grid.sites, time);
    double error = 0;
    for (std::size_t j = 0; j < p.grid.sites; ++j)
      error = std::fmax(error, std::fabs(window.u[j] - reference[step * j]));
    EXPECT_LT(error, step == 4 ? 5e-3 : 3e-4);
    if (last > 0) {
      EXPECT_GT(last / error, 14) << last << " to " << error;
    }
    last = error;
  }
}

}  // namespace
