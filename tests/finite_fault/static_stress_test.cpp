#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

#include "events/finite_fault/source/source.hpp"

namespace {

using namespace slipfront::finite_fault;

constexpr double mu = 30e9, nu = 0.25;

/// A segment of n x n square subfaults, whose slip is a function of the distances from the centre along strike and up
/// dip.
template <class Slip>
SourceSegment square(std::size_t n, double cell, double rake, const Slip& slip) {
  SourceSegment s{.strike = 0,
                  .dip = 90,
                  .cell_length = cell,
                  .cell_width = cell,
                  .along_strike = n,
                  .down_dip = n,
                  .longitude = 0,
                  .latitude = 0,
                  .top = 0};
  const double middle = (static_cast<double>(n) - 1) / 2;
  for (std::size_t j = 0; j < n; ++j)
    for (std::size_t i = 0; i < n; ++i) {
      const double x = (static_cast<double>(i) - middle) * cell, y = (middle - static_cast<double>(j)) * cell;
      s.points.push_back({.longitude = 0,
                          .latitude = 0,
                          .depth = 0,
                          .rake = rake,
                          .slip = slip(x, y),
                          .s_wave_speed = std::sqrt(mu / 2700),
                          .density = 2700,
                          .rupture_time = 0,
                          .rise_time = 1,
                          .rupture_velocity = {}});
    }
  return s;
}

/// Eshelby's crack: slip 8 (1 - nu) / (pi (2 - nu)) (drop / mu) sqrt(a^2 - r^2) for a uniform drop.
double error_of_circular_crack(std::size_t n, double rake) {
  constexpr double radius = 5000, drop = 3e6;
  const double factor = 8 * (1 - nu) / (std::numbers::pi * (2 - nu)) * drop / mu;
  const double cell = 2.4 * radius / static_cast<double>(n);
  const SourceSegment s = square(n, cell, rake, [&](double x, double y) {
    return factor * std::sqrt(std::fmax(0, radius * radius - x * x - y * y));
  });
  const std::vector<double> drops = static_stress_drop(s, nu);
  double worst = 0;
  const double middle = (static_cast<double>(n) - 1) / 2;
  for (std::size_t j = 0; j < n; ++j)
    for (std::size_t i = 0; i < n; ++i)
      if (cell * std::hypot(static_cast<double>(i) - middle, static_cast<double>(j) - middle) < 0.7 * radius)
        worst = std::fmax(worst, std::fabs(drops[j * n + i] / drop - 1));
  return worst;
}

TEST(StaticStress, IsUniformInACircularCrackForEveryRake) {
  for (const double rake : {0.0, 90.0, 30.0, -120.0}) {
    const double coarse = error_of_circular_crack(24, rake), fine = error_of_circular_crack(48, rake);
    EXPECT_LT(coarse, 0.03) << rake;
    EXPECT_LT(fine, 0.6 * coarse) << rake;
  }
}

/// Slip cos(k . x) has the stress drop (mu / 2) (k + nu / (1 - nu) k_s^2 / k) times the slip. Here k_s is the component
/// of k along the slip. Uniform slip in each subfault changes this by (k cell)^2 / 24, and the window by
/// 1 / (2 (k window)^2): together 2 %.
TEST(StaticStress, IsThatOfPlaneWavesOfSlipInTheMiddle) {
  constexpr double cell = 100;
  constexpr std::size_t n = 101;
  for (const auto& [kx, ky, rake] : {std::array{0.6, 0.0, 0.0}, {0.6, 0.0, 90.0}, {0.4, 0.45, 25.0}}) {
    const double a = kx / cell, b = ky / cell;
    const SourceSegment s = square(n, cell, rake, [&](double x, double y) {
      // A smooth window keeps the edges of the segment from counting.
      const double w = std::exp(-(x * x + y * y) / (2 * 1500.0 * 1500.0));
      return w * std::cos(a * x + b * y);
    });
    const double k = std::hypot(a, b), angle = rake * std::numbers::pi / 180;
    const double along = a * std::cos(angle) + b * std::sin(angle);
    const double expected = mu / 2 * (k + nu / (1 - nu) * along * along / k);
    EXPECT_NEAR(static_stress_drop(s, nu)[n * n / 2] / expected, 1, 0.03) << kx << " " << ky << " " << rake;
  }
}

TEST(StaticStress, WeightsTheShearModulusBySlip) {
  SourceSegment s = square(2, 1000, 0, [](double x, double) { return x > 0 ? 1.0 : 0.0; });
  s.points[0].density = 5400;
  EXPECT_NEAR(shear_modulus_of(s), mu, 1);
  for (SourcePoint& p : s.points) p.slip = 0;
  EXPECT_NEAR(shear_modulus_of(s), 1.25 * mu, 1);
  for (const double drop : static_stress_drop(s, nu)) EXPECT_EQ(drop, 0);
}

}  // namespace
