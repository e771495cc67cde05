// Orders of the time integrators of a pulse, on y' = lambda y and on problems that are not linear.

#include "averages/pulse/time/integrators.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

#include "averages/pulse/grid/cells.hpp"

namespace {

using namespace slipfront;
using pulse::Rates;

/// Order of a method whose error at the end is error(steps), from two numbers of steps.
double order_of(const std::function<double(int)>& error, int steps) {
  return std::log2(std::fabs(error(steps)) / std::fabs(error(2 * steps)));
}

/// An equation y' = f(t, y) of two numbers with a known solution.
struct Equation {
  const char* name;
  Rates f;
  std::function<double(double)> width, momentum;
};
std::vector<Equation> equations() {
  return {{"y' = lambda y",
           [](double, const double* y, double* dy) {
             dy[0] = 0.5 * y[0];
             dy[1] = -2 * y[1];
           },
           [](double t) { return std::exp(0.5 * t); }, [](double t) { return std::exp(-2 * t); }},
          {"logistic growth, and a decay that it drives",
           [](double t, const double* y, double* dy) {
             dy[0] = y[0] * (1 - y[0] / 3);
             dy[1] = -y[1] * y[1] * std::cos(t) * y[0] / 3 * (1 + 2 * std::exp(-t));
           },
           [](double t) { return 3 / (1 + 2 * std::exp(-t)); }, [](double t) { return 1 / (1 + std::sin(t)); }}};
}
constexpr double end = 1;

/// The larger error of both numbers after `steps` steps of advance(t, dt, y).
double error_after(int steps, const Equation& equation, std::size_t size,
                   const std::function<void(double, double, std::vector<double>&)>& advance) {
  std::vector<double> y(size, 0.0);
  y[0] = equation.width(0);
  y[1] = equation.momentum(0);
  for (int i = 0; i < steps; ++i) advance(end * i / steps, end / steps, y);
  return std::fmax(std::fabs(y[0] - equation.width(end)), std::fabs(y[1] - equation.momentum(end)));
}

TEST(Ssprk54, ConvergesAtFourthOrder) {
  for (const Equation& equation : equations()) {
    const auto error = [&](int steps) {
      pulse::Ssprk54 step(2);
      std::vector<double> rate(2);
      return error_after(steps, equation, 2, [&](double t, double dt, std::vector<double>& y) {
        equation.f(t, y.data(), rate.data());
        step(equation.f, t, dt, y, rate);
      });
    };
    EXPECT_NEAR(order_of(error, 20), 4, 0.2) << equation.name;
  }
}

TEST(Ssprk54, EstimatesAnErrorOfFourthOrder) {
  const Equation equation = equations().front();
  const auto estimate = [&](int steps) {
    pulse::Ssprk54 step(2);
    std::vector<double> y{1, 1}, rate(2);
    equation.f(0, y.data(), rate.data());
    step(equation.f, 0, end / steps, y, rate);
    return step.error(end / steps, rate, {1, 1}, {0});
  };
  EXPECT_NEAR(order_of(estimate, 20), 4, 0.1);
}

TEST(Rodas4, ConvergesAtFourthOrder) {
  for (const Equation& equation : equations()) {
    const auto error = [&](int steps) {
      pulse::Rodas4 step(1, 2, 1, true);
      std::vector<double> rate(2), next(2);
      const std::vector<double> scale{1, 1};
      return error_after(steps, equation, 2, [&](double t, double dt, std::vector<double>& y) {
        equation.f(t, y.data(), rate.data());
        step.linearise(equation.f, t, y, rate, scale, 0);
        EXPECT_TRUE(step(equation.f, t, dt, y, rate, {scale, 1}, next).succeeded);
        y = next;
      });
    };
    EXPECT_NEAR(order_of(error, 10), 4, 0.35) << equation.name;
  }
}

TEST(Rodas4, DampsAStiffComponentInOneStep) {
  const Rates stiff = [](double, const double* y, double* dy) {
    dy[0] = 0;
    dy[1] = -1e9 * y[1];
  };
  pulse::Rodas4 step(1, 2, 1, false);
  std::vector<double> y{1, 1}, rate(2), next(2);
  const std::vector<double> scale{1, 1};
  stiff(0, y.data(), rate.data());
  step.linearise(stiff, 0, y, rate, scale, 0);
  step(stiff, 0, 1, y, rate, {scale, 1}, next);
  EXPECT_LT(std::fabs(next[1]), 1e-6);
}

TEST(Rodas4, AddsUpSumsByItsDenseOutput) {
  // The width grows as e^t; a third number adds up its square.
  const Rates f = [](double, const double* y, double* dy) {
    dy[0] = y[0];
    dy[1] = 0;
    dy[2] = y[0] * y[0];
  };
  const auto error = [&](int steps) {
    pulse::Rodas4 step(1, 3, 1, false);
    std::vector<double> y{1, 0, 0}, rate(3), next(3);
    const std::vector<double> scale{1, 1};
    for (int i = 0; i < steps; ++i) {
      f(0, y.data(), rate.data());
      step.linearise(f, 0, y, rate, scale, 0);
      step(f, end * i / steps, end / steps, y, rate, {scale, 1}, next);
      y = next;
    }
    return y[2] - (std::exp(2.0) - 1) / 2;
  };
  EXPECT_NEAR(order_of(error, 10), 4, 0.3);
}

/// One Euler step of an equation: explicit in the width, linearly implicit in the momentum.
pulse::ExtrapolatedEuler::Step semi_implicit(const Equation& equation) {
  return [&equation](double t, double dt, const double* y, double* next) {
    constexpr double small = 1e-7;
    double rate[2], shifted_rate[2];
    const double shifted[2] = {y[0], y[1] + small};
    equation.f(t, y, rate);
    equation.f(t, shifted, shifted_rate);
    const double slope = (shifted_rate[1] - rate[1]) / small;
    next[0] = y[0] + dt * rate[0];
    next[1] = y[1] + dt * rate[1] / (1 - dt * slope);
  };
}

TEST(ExtrapolatedEuler, ConvergesAtSecondOrder) {
  for (const Equation& equation : equations()) {
    const auto error = [&](int steps) {
      pulse::ExtrapolatedEuler step(2);
      std::vector<double> next(2);
      return error_after(steps, equation, 2, [&](double t, double dt, std::vector<double>& y) {
        step(semi_implicit(equation), t, dt, y, next);
        y = next;
      });
    };
    EXPECT_NEAR(order_of(error, 80), 2, 0.1) << equation.name;
  }
}

TEST(ExtrapolatedEuler, EstimatesTheErrorOfTheFirstOrderMethod) {
  const Equation equation = equations().front();
  const auto estimate = [&](int steps) {
    pulse::ExtrapolatedEuler step(2);
    std::vector<double> next(2);
    step(semi_implicit(equation), 0, end / steps, {1, 1}, next);
    return step.difference(1);
  };
  EXPECT_NEAR(order_of(estimate, 80), 2, 0.1);
}

/// The momentum decays by friction, implicitly; the width grows explicitly.
TEST(Ars443, ConvergesAtThirdOrder) {
  const auto error_of = [](bool linear, int steps) {
    pulse::Ars443 step(1, pulse::Values::size(1));
    const Rates f = [](double, const double* y, double* dy) {
      std::fill_n(dy, pulse::Values::size(1), 0.0);
      dy[0] = 0.5 * y[0];
    };
    // M + time 2 M = free, or M + time M^2 = free.
    const auto friction = [linear](const double*, const double* free, double time, double* momentum, double* velocity) {
      *momentum = linear ? *free / (1 + 2 * time) : 2 * *free / (1 + std::sqrt(1 + 4 * time * *free));
      *velocity = *momentum;
    };
    std::vector<double> y(pulse::Values::size(1)), rate(y.size());
    y[0] = y[1] = 1;
    for (int i = 0; i < steps; ++i) {
      f(0, y.data(), rate.data());
      step(f, friction, end * i / steps, end / steps, y, rate);
    }
    return std::fmax(std::fabs(y[0] - std::exp(0.5)), std::fabs(y[1] - (linear ? std::exp(-2.0) : 0.5)));
  };
  for (const bool linear : {true, false})
    EXPECT_NEAR(order_of([&](int steps) { return error_of(linear, steps); }, 20), 3, 0.15) << linear;
}

/// Error estimate of one step from the momentum `start` under a force 1 + t and the friction rate `rate`.
double estimate_under_friction(double start, double rate, double dt) {
  pulse::Ars443 step(1, pulse::Values::size(1));
  const Rates f = [](double t, const double*, double* dy) {
    std::fill_n(dy, pulse::Values::size(1), 0.0);
    dy[1] = 1 + t;
  };
  const auto friction = [rate](const double*, const double* free, double time, double* momentum, double* velocity) {
    *momentum = *velocity = *free / (1 + rate * time);
  };
  std::vector<double> y(pulse::Values::size(1)), rate_at_start(y.size());
  y[0] = 1;
  y[1] = start;
  f(0, y.data(), rate_at_start.data());
  step(f, friction, 0, dt, y, rate_at_start);
  return step.error(y, {1, 1 / rate}, {0}, {rate * dt});
}

/// The mean momentum is off by 0.07 of the change of the force, and the momentum at the end by 0.4 of it. The
/// difference from the midpoint rule exceeds the change of the force by the length of the step in friction times.
TEST(Ars443, EstimatesTheErrorOfAMomentumThatFrictionBalances) {
  for (const double dt : {1e-3, 1e-2, 1e-1}) {
    const double estimate = estimate_under_friction(1e-8, 1e8, dt);
    EXPECT_LT(estimate, 0.4 * dt);
    EXPECT_GT(estimate, 0.07 * dt);
  }
}

TEST(Ars443, RejectsAStepInWhichTheMomentumOnlyReachesItsBalance) {
  for (const double dt : {1e-7, 1e-4, 1e-1}) EXPECT_GT(estimate_under_friction(0, 1e8, dt), 0.1) << dt;
}

}  // namespace
