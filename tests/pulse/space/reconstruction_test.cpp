// Point values from averages and faces by WENO, on profiles whose exact values are known.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <vector>

#include "foundation/math/weno.hpp"
#include "pulse/space/kernels.hpp"

namespace {

using namespace slipfront;
using std::numbers::pi;

/// Averages of sin(2 pi x + 0.3) over the n cells of a period, and `ghosts` more at both ends.
std::vector<double> averages(int n, int ghosts) {
  std::vector<double> f;
  const auto integral = [](double x) { return -std::cos(2 * pi * x + 0.3) / (2 * pi); };
  for (int i = -ghosts; i < n + ghosts; ++i) f.push_back((integral((i + 1.0) / n) - integral(1.0 * i / n)) * n);
  return f;
}

double order(const std::function<double(int)>& error, int n) { return std::log2(error(n) / error(2 * n)); }

double error_at_faces(int n) {
  const std::vector<double> f = averages(n, 3);
  double worst = 0;
  for (int i = 0; i < n; ++i) {
    const double* at = f.data() + i + 3;
    const double face = weno5(at[-2], at[-1], at[0], at[1], at[2]);
    worst = std::fmax(worst, std::fabs(face - std::sin(2 * pi * (i + 1.0) / n + 0.3)));
  }
  return worst;
}

TEST(Weno5, ConvergesAtFifthOrderOnSmoothData) { EXPECT_NEAR(order(error_at_faces, 64), 5, 0.3); }

TEST(Weno5, DoesNotOscillateAtAJump) {
  for (const double low : {0.0, 1e-9, 0.3})
    for (int jump = 1; jump < 5; ++jump) {
      double f[5];
      for (int i = 0; i < 5; ++i) f[i] = i < jump ? 1 : low;
      const double face = weno5(f[0], f[1], f[2], f[3], f[4]);
      EXPECT_LE(face, 1 + 1e-6) << jump;
      EXPECT_GE(face, low - 1e-6) << jump;
    }
}

TEST(Weno5, TakesTheSmoothSideOfAJump) {
  // A parabola to the left of the jump; the face lies on that side.
  const auto average = [](double i) { return (std::pow(i + 0.5, 3) - std::pow(i - 0.5, 3)) / 3; };
  const double face = weno5(average(-2), average(-1), average(0), 1000, 1000);
  EXPECT_NEAR(face, 0.25, 1e-3);
}

TEST(Weno5, DoesNotDependOnTheUnit) {
  const double face = weno5(1, 2, 4, 5, 3);
  for (const double unit : {1e-100, 1e-20, 1e60})
    EXPECT_NEAR(weno5(unit, 2 * unit, 4 * unit, 5 * unit, 3 * unit) / unit, face, 1e-12);
}

double error_of_centres(int n) {
  const std::vector<double> f = averages(n, 2);
  std::vector<double> values(f.size());
  pulse::centre_values(f.size(), {0, f.size()}, f.data(), values.data());
  double worst = 0;
  for (int i = 0; i < n; ++i)
    worst =
        std::fmax(worst, std::fabs(values[static_cast<std::size_t>(i + 2)] - std::sin(2 * pi * (i + 0.5) / n + 0.3)));
  return worst;
}

/// Fourth order at least: near the zeros of its fourth differences, sixth order is given up.
TEST(CentreValues, ConvergeAtFourthOrderOrMore) { EXPECT_GT(order(error_of_centres, 64), 3.8); }

TEST(CentreValues, AreUndoneByCellMeans) {
  const std::vector<double> f = averages(200, 2);
  std::vector<double> values(f.size()), back(f.size());
  pulse::centre_values(f.size(), {0, f.size()}, f.data(), values.data());
  pulse::cell_means(f.size(), {0, f.size()}, values.data(), back.data());
  for (std::size_t i = 4; i + 4 < f.size(); ++i) EXPECT_NEAR(back[i], f[i], 1e-9) << i;
}

}  // namespace
