#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "chain/explicit/levels/contact_force.hpp"
#include "chain/explicit/levels/kernel.hpp"
#include "chain/implicit/watched_parts.hpp"

namespace {

namespace chains = slipfront::chain;

/// All sites count, also those that do not fill a vector.
TEST(ChainKernels, WorkOfCoulombFrictionCountsAllSites) {
  for (std::size_t size = 1; size <= 40; ++size) {
    std::vector<double> D;
    double sum = 0;
    for (std::size_t j = 0; j < size; ++j) {
      D.push_back((j % 2 == 0 ? 1 : -1) * std::sqrt(static_cast<double>(j + 1)));
      sum += std::fabs(D.back());
    }
    EXPECT_NEAR(chains::work_of_coulomb_friction(D.data(), size), sum, 1e-13 * sum) << size;
  }
}

/// Sums over sites are those of their definitions, for any number of sites.
TEST(ChainKernels, SumWorkAndEnergyOverAllSites) {
  const double two_pi = 2 * std::acos(-1.0);
  const chains::PeriodicForce sine = chains::substrate_force(0);
  for (std::size_t size = 1; size <= 40; ++size) {
    std::vector<double> before, now, next, D, B, a2, a2_next, u;
    double work = 0, energy = 0;
    for (std::size_t j = 0; j < size; ++j) {
      const auto i = static_cast<double>(j);
      before.push_back(std::sin(i));
      now.push_back(1 + std::cos(2 * i));
      next.push_back(std::sin(3 * i) - 0.4);
      D.push_back(0.3 * std::cos(i + 1));
      B.push_back(0.2 * std::sin(i + 2));
      a2.push_back(0.5 + 0.3 * std::sin(2 * i));
      a2_next.push_back(0.6 + 0.2 * std::cos(i));
      u.push_back(0.37 * i);
      // Simpson's rule, with the force over the step as a parabola in time.
      work += (now[j] + next[j]) / 2 * D[j] + (next[j] - before[j]) / 12 * B[j];
      energy += (a2_next[j] - a2[j]) * (1 - (std::cos(two_pi * u[j]) + std::cos(two_pi * u[j] - D[j])) / 2);
    }
    EXPECT_NEAR(chains::work_of_force(before.data(), now.data(), next.data(), D.data(), B.data(), size), work, 1e-13);
    EXPECT_NEAR(chains::energy_of_contacts(sine, a2.data(), a2_next.data(), u.data(), D.data(), size), energy, 1e-9);
  }
}

/// A step that is a rounding error of z, or of a thousandth of a turn, is none.
TEST(ChainKernels, IgnoreSpeedsOfRoundingErrors) {
  const double from[] = {10, 10, -10, 0, 0}, next[] = {10 + 1e-14, 10 + 1e-13, -10 - 1e-13, 1e-18, 1e-17};
  double free[5];
  EXPECT_TRUE(chains::free_speeds(4, from, next, free, 5));
  for (const std::size_t j : {0u, 3u}) EXPECT_EQ(free[j], 0) << j;
  for (const std::size_t j : {1u, 2u, 4u}) EXPECT_EQ(free[j], 4 * std::fabs(next[j] - from[j])) << j;
  EXPECT_FALSE(chains::free_speeds(4, from, next, free, 1));
}

/// The polynomial in a^2 has the least error over the range of a^2 if its error is as large at 0 as in the middle.
TEST(ChainKernels, ContactForceIsAsExactAtTheEndsAsBetween) {
  constexpr double eps = 0.03, most = 1.5;
  const chains::ContactForce force = chains::contact_force(eps, most);
  const auto error = [&](double a2) {
    const chains::PeriodicForce exact = chains::substrate_force(eps * a2);
    double largest = 0;
    for (int k = 0; k < chains::PeriodicForce::terms; ++k)
      largest = std::fmax(largest, std::fabs(force.coefficient(k, a2) - exact.c[k]));
    return largest;
  };
  double between = 0;
  for (int i = 1; i < 100; ++i) between = std::fmax(between, error(most * i / 100));
  EXPECT_GT(between, 1e-12);
  EXPECT_LT(between, 1e-3);
  EXPECT_LT(error(0), 3 * between);
  EXPECT_LT(error(most), 3 * between);
}

TEST(ChainKernels, PartsHaveTheirMiddles) {
  chains::Problem problem;
  problem.grid = {.left = -3, .spacing = 0.1, .sites = 61};
  const std::vector<double> middles = chains::middles_of_parts(problem, 1);
  ASSERT_EQ(middles.size(), 1u);
  EXPECT_NEAR(middles[0], 0, 1e-14);
}

}  // namespace
