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
