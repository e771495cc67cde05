// Point values from averages and faces by WENO, on profiles whose exact values are known.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <vector>

#include "averages/pulse/space/kernels.hpp"
#include "math/weno.hpp"

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

/// The averages of a polynomial of fifth degree give its values, and these the averages.
TEST(CentreValues, AreExactForPolynomialsOfFifthDegree) {
  const auto f = [](double x) { return 3 + x * x + 1e-3 * x * x * x * x + 1e-4 * x * x * x * x * x; };
  const auto integral = [](double x) {
    return 3 * x + x * x * x / 3 + 2e-4 * std::pow(x, 5) + 1e-4 / 6 * std::pow(x, 6);
  };
  std::vector<double> mean, middle;
  for (int i = -4; i <= 4; ++i) {
    middle.push_back(f(i));
    mean.push_back(integral(i + 0.5) - integral(i - 0.5));
  }
  std::vector<double> values(mean.size()), means(mean.size());
  pulse::centre_values(mean.size(), {0, mean.size()}, mean.data(), values.data());
  pulse::cell_means(mean.size(), {0, mean.size()}, middle.data(), means.data());
  for (std::size_t i = 2; i + 2 < mean.size(); ++i) {
    EXPECT_NEAR(values[i], middle[i], 1e-13) << i;
    EXPECT_NEAR(means[i], mean[i], 1e-13) << i;
  }
}

TEST(WenoFaces, TakeEachInvariantFromItsOwnSide) {
  constexpr std::size_t faces = 5, cells = faces - 1 + 6;
  std::vector<double> plus, minus, phi(faces), psi(faces);
  for (std::size_t i = 0; i < cells; ++i) {
    plus.push_back(std::sin(1.3 * double(i)) + (i > 6 ? 2 : 0));
    minus.push_back(std::cos(0.7 * double(i)) - 0.3);
  }
  const double *p = plus.data() + 3, *m = minus.data() + 3, scale = 1.7;
  pulse::weno_faces(faces, p, m, scale, phi.data(), psi.data());
  for (std::size_t f = 0; f < faces; ++f) {
    const double left = weno5(plus[f], plus[f + 1], plus[f + 2], plus[f + 3], plus[f + 4]);
    const double right = weno5(minus[f + 5], minus[f + 4], minus[f + 3], minus[f + 2], minus[f + 1]);
    EXPECT_NEAR(phi[f], scale * (left + right) / 2, 1e-14) << f;
    EXPECT_NEAR(psi[f], scale * std::fmax(left - right, 0.0) / 2, 1e-14) << f;
  }
}

}  // namespace
