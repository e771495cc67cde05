#include "slipfront/theory/train.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "error_metric.hpp"
#include "reference_table.hpp"
#include "slipfront/error.hpp"

namespace {

using namespace slipfront;
using std::numbers::pi;

TEST(TrainAverages, MatchTheQuadratureOfTheFields) {
  for (const auto& row : reference_table("train.csv")) {
    const train::Averages a = train::averages({row["phi"], row["psi"]});
    const struct {
      const char* name;
      double value;
    } columns[] = {
        {"k", a.k}, {"W", a.W}, {"sigma2", a.sigma2}, {"sigma3", a.sigma3}, {"one_minus_cos", a.one_minus_cos},
        {"P", a.P}, {"Q", a.Q}, {"H", a.H},           {"I", a.I},           {"J", a.J}};
    for (const auto& column : columns)
      EXPECT_LE(error_in_eps(column.value, row[column.name]), 16)
          << column.name << " at phi = " << row.text("phi") << ", psi = " << row.text("psi");
  }
}

/// The trapezoidal rule is spectral for periodic functions.
TEST(TrainAverages, MatchTheLibrarysFields) {
  for (const State state : {State{0.0, 0.4}, State{0.3, 0.2}, State{-1.2, 1.1}}) {
    const double length = train::spacing(state), U = std::tanh(state.phi);
    constexpr int n = 400;
    double sigma = 0, w = 0, sigma2 = 0, sigma3 = 0, potential = 0;
    for (int i = 0; i < n; ++i) {
      const train::Fields f = train::fields(state, length * i / n);
      sigma += f.sigma / n;
      w += f.w / n;
      sigma2 += f.sigma * f.sigma / n;
      sigma3 += f.sigma * f.sigma * f.sigma / n;
      potential += (1 - std::cos(f.u)) / n;
    }
    const train::Averages a = train::averages(state);
    EXPECT_LE(error_in_eps(sigma, a.k), 100);
    EXPECT_NEAR(w, a.W, 1e-13);
    EXPECT_LE(error_in_eps(sigma2, a.sigma2), 100);
    EXPECT_LE(error_in_eps(sigma3, a.sigma3), 100);
    EXPECT_LE(error_in_eps(potential, a.one_minus_cos), 100);
    EXPECT_NEAR(a.Q, (1 + U * U) / 2 * a.sigma2 - a.one_minus_cos, 1e-13 * a.sigma2);
    EXPECT_NEAR(a.I, a.P / a.k, 1e-14 * std::fabs(a.I));
    EXPECT_NEAR(a.k, 2 * pi / length, 1e-14 * a.k);
  }
}

TEST(TrainFields, SolveSineGordon) {  // Eq. (3) without F and f, along xi: (U^2 - 1) u'' + sin u = 0, and sigma = -u'
  for (const State state : {State{0.0, 1e-3}, State{0.4, 0.05}, State{-0.8, 0.6}, State{1.5, 2.0}}) {
    const double U = std::tanh(state.phi), length = train::spacing(state),
                 h = 1e-3 * std::fmin(1.0, length / std::cosh(state.phi));
    for (double part = -0.93; part < 2; part += 0.17) {
      const double xi = part * length;
      const auto u = [&](int i) { return train::fields(state, xi + i * h).u; };
      const double second = (-u(2) + 16 * u(1) - 30 * u(0) + 16 * u(-1) - u(-2)) / (12 * h * h);
      const double first = (-u(2) + 8 * u(1) - 8 * u(-1) + u(-2)) / (12 * h);
      const train::Fields f = train::fields(state, xi);
      const double scale = 1 + std::fabs(second);
      EXPECT_NEAR((U * U - 1) * second + std::sin(f.u), 0, 1e-7 * scale)
          << state.phi << " " << state.psi << " " << part;
      EXPECT_NEAR(f.sigma, -first, 1e-8 * (1 + std::fabs(first)));
      EXPECT_NEAR(f.w, U * f.sigma, 1e-15 * (1 + f.sigma));
    }
  }
}

TEST(TrainFields, FallByTwoPiOverEachDislocation) {
  const State state{0.2, 1e-5};
  const double length = train::spacing(state);
  EXPECT_NEAR(train::fields(state, 0).u, pi, 1e-14);
  EXPECT_NEAR(train::fields(state, 3 * length).u, pi - 6 * pi, 1e-9);
  EXPECT_GT(train::fields(state, length / 2).sigma, 0);  // never quite zero, even between distant kinks
  EXPECT_LE(error_in_eps(train::fields({0, 1e-250}, train::spacing({0, 1e-250}) / 2).sigma, 2e-250), 8);
}

TEST(Train, HasNoAveragesWithoutDislocations) {
  const train::Averages a = train::averages({0.7, 0});
  EXPECT_EQ(a.k, 0);
  EXPECT_EQ(a.W, 0);
  EXPECT_EQ(a.P, 0);
  EXPECT_EQ(a.Q, 0);
  EXPECT_EQ(a.H, 0);
  const train::Averages nearly = train::averages({0.7, 1e-300});
  EXPECT_NEAR(a.J, nearly.J, 1e-15);
  EXPECT_THROW(train::fields({0, 0}, 1), InputError);
}

}  // namespace
