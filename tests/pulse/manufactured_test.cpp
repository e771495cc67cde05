// Order of accuracy by a manufactured solution. Any motion of the dislocations that starts at rest is a solution for
// one forcing: with x(q, t) chosen, l = x_q and U = x_t give M, and F follows from the momentum law.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "averages/pulse/solver.hpp"
#include "slipfront/friction/friction.hpp"
#include "slipfront/theory/modulation/modulation.hpp"
#include "slipfront/theory/train.hpp"

namespace {

using namespace slipfront;
using namespace slipfront::pulse;
using friction::Closure;
using friction::Friction;
using std::numbers::pi;

/// 2 pi N(x, t) = k0 y + lump exp(-y^2) + moved g(t) y exp(-y^2), y = x - pushed g(t), g = 1 - cos(t / 2): a uniform
/// train that is pushed on from rest, with a lump in it that changes. All dislocations go forward, so that Coulomb
/// friction is smooth.
struct Motion {
  static constexpr double k0 = 0.7, lump = 0.12, moved = 0.1, pushed = 0.3, rate = 0.4;
  static double y_of(double x, double t) { return x - pushed * (1 - std::cos(rate * t)); }
  static double density(double x, double t) {  // 2 pi N_x
    const double y = y_of(x, t);
    return k0 + std::exp(-y * y) * (-2 * lump * y + moved * (1 - std::cos(rate * t)) * (1 - 2 * y * y));
  }
  static double flux(double x, double t) {  // k U = -2 pi N_t
    const double y = y_of(x, t);
    return rate * std::sin(rate * t) * (pushed * density(x, t) - moved * y * std::exp(-y * y));
  }
  bool rough = false;  ///< the contact ratio varies
  double contact(double x) const { return rough ? 1 + 0.3 * std::exp(-x * x / 2) : 1; }

  State state(double x, double t) const {  // k = a pi cosh phi cosh psi / K
    const double k = density(x, t), U = flux(x, t) / k;
    return {std::atanh(U), train::psi_of_stress(k / contact(x) * std::sqrt(1 - U * U))};
  }
  train::Averages at(double x, double t) const { return train::averages(state(x, t), contact(x)); }

  /// F = (P_t + Q_x + <1 - cos u> (a^2)_x + loss) / k, derivatives by differences of fourth order, exact to 1e-11.
  double forcing(double x, double t, const Friction& friction) const {
    constexpr double h = 0.001, weight[2] = {2.0 / 3, -1.0 / 12};
    double P_t = 0, Q_x = 0, a2_x = 0;
    for (int j = 1; j <= 2; ++j) {
      P_t += weight[j - 1] * (at(x, t + j * h).P - at(x, t - j * h).P) / h;
      Q_x += weight[j - 1] * (at(x + j * h, t).Q - at(x - j * h, t).Q) / h;
      a2_x += weight[j - 1] * (std::pow(contact(x + j * h), 2) - std::pow(contact(x - j * h), 2)) / h;
    }
    // Friction of what is about to go forward, at t = 0 too.
    const double loss = density(x, t) * friction.mean_strength(state(x, t), contact(x));
    return (P_t + Q_x + at(x, t).one_minus_cos * a2_x + loss) / density(x, t);
  }
};

/// Mean error of the cells' k and P at `end`.
struct Errors {
  double k, P;
};
Errors errors_of(const Motion& motion, const Friction& friction, int cells, double end) {
  Problem p;
  p.stress = [](double x) { return Motion::density(x, 0); };
  p.forcing = [&](double x, double t) { return motion.forcing(x, t, friction); };
  if (motion.rough) p.contact = [&](double x) { return motion.contact(x); };
  p.friction = friction;
  p.left = -7;
  p.right = 7;
  p.cells = cells;
  p.corner = HUGE_VAL;
  Solver s(p);
  s.advance_to(end);
  const auto view = s.view();
  constexpr double node = 0.77459666924148338, weight[3] = {5.0 / 18, 8.0 / 18, 5.0 / 18};
  Errors e{0, 0};
  for (std::size_t i = 0; i < s.size(); ++i) {
    const double a = view.faces[i], width = view.faces[i + 1] - a;
    double k = 0, P = 0;
    for (int j = 0; j < 3; ++j) {
      const double x = a + width * (1 + (j - 1) * node) / 2;
      k += weight[j] * Motion::density(x, end);
      P += weight[j] * motion.at(x, end).P;
    }
    e.k += std::fabs(2 * pi * s.charge()[i] / width - k) / cells;
    e.P += std::fabs(s.cells().momentum(i) / width - P) / cells;
  }
  return e;
}

void expect_fourth_order(const Motion& motion, const Friction& friction) {
  Errors last = errors_of(motion, friction, 80, 2);
  for (const int cells : {160, 320}) {
    const Errors now = errors_of(motion, friction, cells, 2);
    const double order_k = std::log2(last.k / now.k), order_P = std::log2(last.P / now.P);
    std::printf("%d cells: errors %.2g in k, %.2g in P; orders %.2f, %.2f\n", cells, now.k, now.P, order_k, order_P);
    EXPECT_GE(order_k, 4);
    EXPECT_GE(order_P, 4);
    last = now;
  }
  EXPECT_LT(last.k, 1e-8);
  EXPECT_LT(last.P, 1e-8);
}

TEST(Manufactured, FourthOrderWithoutFriction) { expect_fourth_order({}, {}); }

TEST(Manufactured, FourthOrderWithEveryLawAndClosure) {
  expect_fourth_order({}, friction::coulomb(0.4, Closure::consistent));  // both closures are equal for this motion
  for (const Closure closure : {Closure::consistent, Closure::paper}) {
    expect_fourth_order({}, friction::viscous(0.4, closure));
    expect_fourth_order({}, friction::power(0.4, 2, closure));
  }
}

TEST(Manufactured, FourthOrderWithAContactProfile) {
  expect_fourth_order({.rough = true}, {});
  expect_fourth_order({.rough = true}, friction::viscous(0.4, Closure::consistent));
  expect_fourth_order({.rough = true}, friction::viscous(0.4, Closure::paper));
}

}  // namespace
