// The right sides of Eqs. 8.7 and 8.8 for motions without symmetry. The references come from the Lagrangian, and from
// the fluxes of exact states, by differences of high order. They share no formula with the solvers: K and E come from
// the arithmetic-geometric mean.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "averages/grid/equations.hpp"
#include "averages/loops/equations.hpp"

namespace {

using namespace slipfront;
using plane::Point;
using plane::Problem;
using std::numbers::pi;

/// A train at rest with tanh^2(psi) = m1.
struct StaticTrain {
  double K, E, psi;

  explicit StaticTrain(double of_psi) : psi(of_psi) {
    double a = 1, b = std::tanh(psi), sum = 1 - b * b, power = 1;  // E = K (1 - sum of 2^(n - 1) c_n^2)
    for (int n = 0; n < 9; ++n) {
      const double half = (a - b) / 2, mean = (a + b) / 2;
      b = std::sqrt(a * b);
      a = mean;
      sum += 2 * power * half * half;
      power *= 2;
    }
    K = pi / (2 * a);
    E = K * (1 - sum / 2);
  }
  static StaticTrain with_density(double kappa) {
    double low = 1e-4, high = 6;
    for (int i = 0; i < 56; ++i) {
      const double middle = (low + high) / 2;
      (StaticTrain(middle).kappa() < kappa ? low : high) = middle;
    }
    return StaticTrain(low);
  }
  double kappa() const { return pi * std::cosh(psi) / K; }
  double J0() const { return 4 / pi * std::cosh(psi) * E; }
  double pressure() const { return 2 * std::sinh(psi) * std::sinh(psi); }
  double H0() const { return kappa() * J0() - pressure(); }
};

/// f'(x), by differences of sixth order.
template <class F>
double slope_of(const F& f, double x, double h = 0.02) {
  return (45 * (f(x + h) - f(x - h)) - 9 * (f(x + 2 * h) - f(x - 2 * h)) + (f(x + 3 * h) - f(x - 3 * h))) / (60 * h);
}

double contact_at(double x, double y) { return 1 + 0.2 * std::sin(0.7 * x + 0.4) * std::cos(0.5 * y - 0.3); }

/// Loops r(theta, q, t) that no rotation and no mirror maps onto themselves.
struct MovingLoops {
  bool rough = false;  ///< the contact ratio varies

  static double r(double theta, double q, double t) {
    return 2 - 0.9 * q - 0.15 * q * q +
           (0.22 * std::cos(theta + 0.3) + 0.14 * std::sin(2 * theta) + 0.1 * q * std::cos(3 * theta)) * (1 + t) +
           0.5 * t * (1 - 0.3 * q) + 0.2 * t * t;
  }
  double contact(double theta, double r) const {
    return rough ? contact_at(r * std::cos(theta), r * std::sin(theta)) : 1;
  }

  /// The motion of one loop at one angle.
  struct Local {
    double theta, r, by_theta, by_q, by_t;
  };
  static Local at(double theta, double q, double t) {
    return {theta, r(theta, q, t), slope_of([&](double x) { return r(x, q, t); }, theta),
            slope_of([&](double x) { return r(theta, x, t); }, q),
            slope_of([&](double x) { return r(theta, q, x); }, t)};
  }
  /// -r l H0(kappa), and a^2 H0(kappa / a) with a contact ratio.
  double lagrangian(const Local& at) const {
    const double D = 1 + at.by_theta * at.by_theta / (at.r * at.r) - at.by_t * at.by_t, l = -at.by_q;
    const double a = contact(at.theta, at.r);
    return -at.r * l * a * a * StaticTrain::with_density(2 * pi * std::sqrt(D) / l / a).H0();
  }
  double derivative(Local at, double Local::*of) const {
    const double value = at.*of;
    return slope_of(
        [&](double x) {
          at.*of = x;
          return lagrangian(at);
        },
        value, 1e-3);
  }
  double momentum(double theta, double q, double t) const { return derivative(at(theta, q, t), &Local::by_t); }
  /// Pi_t of the Euler-Lagrange equation.
  double momentum_rate(double theta, double q, double t) const {
    return derivative(at(theta, q, t), &Local::r) -
           slope_of([&](double x) { return derivative(at(x, q, t), &Local::by_theta); }, theta) -
           slope_of([&](double x) { return derivative(at(theta, x, t), &Local::by_q); }, q);
  }
};

/// Root mean squares of the errors of the rates in the inner half of the rows, over those of the rates.
struct RateErrors {
  double r, momentum;
};
RateErrors errors_of_loops(const MovingLoops& motion, std::size_t rows, std::size_t angles) {
  constexpr double t = 0.1, most = 0.8;  // the largest label
  Problem problem;
  if (motion.rough) problem.contact = contact_at;
  plane::Loops loops;
  loops.rows = rows;
  loops.angles = angles;
  loops.wall.assign(angles, 0);
  const double charge = most / static_cast<double>(rows);
  for (std::size_t row = 0; row <= rows; ++row) loops.label.push_back(static_cast<double>(row) * charge);
  for (std::size_t row = 0; row <= rows; ++row)
    for (std::size_t k = 0; k < angles; ++k) loops.r.push_back(MovingLoops::r(loops.angle(k), loops.label[row], t));
  const auto middle = [&](std::size_t row) { return loops.label[row] + charge / 2; };
  for (std::size_t row = 0; row < rows; ++row)
    for (std::size_t k = 0; k < angles; ++k) loops.momentum.push_back(motion.momentum(loops.angle(k), middle(row), t));
  loops.s.assign(loops.cells(), 0.3);
  std::vector<double> r_rate(loops.r.size()), momentum_rate(loops.cells());
  plane::LoopEquations equations(problem, loops);
  equations.find_rates(t, loops.r, loops.momentum, loops.s, r_rate, momentum_rate);
  double of_r = 0, of_momentum = 0, size_r = 0, size_momentum = 0;
  for (std::size_t row = rows / 4; row < rows - rows / 4; ++row)
    for (std::size_t k = 0; k < angles; k += angles / 8) {
      const double theta = loops.angle(k), exact_r = MovingLoops::at(theta, loops.label[row], t).by_t;
      const double exact = motion.momentum_rate(theta, middle(row), t);
      of_r += std::pow(r_rate[row * angles + k] - exact_r, 2);
      of_momentum += std::pow(momentum_rate[row * angles + k] - exact, 2);
      size_r += exact_r * exact_r;
      size_momentum += exact * exact;
    }
  return {std::sqrt(of_r / size_r), std::sqrt(of_momentum / size_momentum)};
}

/// The errors of the rates fall as the square of the size of the cells.
TEST(PlaneManufactured, RatesOfLoopsAreThoseOfTheLagrangian) {
  for (const bool rough : {false, true}) {
    const RateErrors coarse = errors_of_loops({rough}, 16, 32), fine = errors_of_loops({rough}, 32, 64);
    EXPECT_LT(fine.r, 5e-4) << rough;
    EXPECT_LT(fine.momentum, 5e-4) << rough;
    EXPECT_GT(coarse.r, 3.5 * fine.r) << rough << ": " << coarse.r << ", " << fine.r;
    EXPECT_GT(coarse.momentum, 3.5 * fine.momentum) << rough << ": " << coarse.momentum << ", " << fine.momentum;
  }
}

/// A force F pushes each loop by 2 pi r F, and its power is the integral of F U_t.
TEST(PlaneManufactured, AForcePushesLoopsAndSuppliesItsPower) {
  constexpr double t = 0.1, charge = 0.05;
  const auto force = [](double x, double y, double now) { return 0.3 + x - 0.5 * y * y + now; };
  Problem still, pushed;
  pushed.forcing = force;
  plane::Loops loops;
  loops.rows = 16;
  loops.angles = 64;
  loops.wall.assign(loops.angles, 0);
  for (std::size_t row = 0; row <= loops.rows; ++row) {
    loops.label.push_back(charge * static_cast<double>(row));
    for (std::size_t k = 0; k < loops.angles; ++k)
      loops.r.push_back(MovingLoops::r(loops.angle(k), loops.label[row], t));
  }
  const MovingLoops motion;
  double power = 0;
  for (std::size_t i = 0; i < loops.cells(); ++i) {
    const double theta = loops.angle(i % loops.angles), q = loops.label[i / loops.angles] + charge / 2;
    const MovingLoops::Local at = MovingLoops::at(theta, q, t);
    loops.momentum.push_back(motion.momentum(theta, q, t));
    // U_t dA = 2 pi r_t / l r dr dtheta, and dr = l dq.
    power += 2 * pi * force(at.r * std::cos(theta), at.r * std::sin(theta), t) * at.r * at.by_t * charge * loops.turn();
  }
  std::vector<double> guesses(loops.cells(), 0.3), r_rate(loops.r.size()), rate(loops.cells()), with_force(rate);
  plane::LoopEquations free(still, loops), forced(pushed, loops);
  free.find_rates(t, loops.r, loops.momentum, guesses, r_rate, rate);
  forced.find_rates(t, loops.r, loops.momentum, guesses, r_rate, with_force);
  for (std::size_t i = 0; i < loops.cells(); ++i) {
    const double theta = loops.angle(i % loops.angles), r = forced.middle(i);
    EXPECT_NEAR(with_force[i] - rate[i], 2 * pi * r * force(r * std::cos(theta), r * std::sin(theta), t), 1e-11);
  }
  EXPECT_NEAR(forced.supply() / power, 1, 1e-3);
  EXPECT_EQ(free.supply(), 0);
}

/// A wave moves along a loop at most with the speed 1. Where the angles are close, that limits the step.
TEST(PlaneManufactured, AWaveAlongALoopPassesLessThanAnAngleInAStep) {
  plane::Loops loops;
  loops.rows = 8;
  loops.angles = 512;
  loops.wall.assign(loops.angles, 0);
  for (std::size_t row = 0; row <= loops.rows; ++row) {
    loops.label.push_back(0.1 * static_cast<double>(row));
    for (std::size_t k = 0; k < loops.angles; ++k) loops.r.push_back(2 - loops.label[row]);
  }
  loops.momentum.assign(loops.cells(), 0);
  loops.s.assign(loops.cells(), 0.3);
  std::vector<double> r_rate(loops.r.size()), rate(loops.cells());
  const Problem problem;
  plane::LoopEquations equations(problem, loops);
  equations.find_rates(0, loops.r, loops.momentum, loops.s, r_rate, rate);
  const double shortest = equations.middle(loops.cells() - 1) * loops.turn();
  EXPECT_LT(equations.longest_step(), shortest);
  EXPECT_GT(equations.longest_step(), 0.5 * shortest);
}

/// Slip and velocity of the lines without symmetry, with a slope everywhere.
struct MovingSlip {
  bool rough = false;

  static double slip(double x, double y) {
    return 6 + 1.1 * x + 0.6 * y + 0.25 * std::sin(x - 0.4 * y + 0.2) + 0.15 * std::cos(0.8 * y + 0.5 * x);
  }
  static double velocity(double x, double y) { return 0.3 + 0.2 * std::sin(0.7 * x + y) * std::cos(0.3 * x - 0.2); }
  double contact(double x, double y) const { return rough ? contact_at(x, y) : 1; }

  static std::array<double, 2> gradient(double x, double y) {
    return {slope_of([&](double at) { return slip(at, y); }, x), slope_of([&](double at) { return slip(x, at); }, y)};
  }
  /// J0 / kappa of the train in its frame. A contact ratio a makes it a J0(kappa / a) / kappa.
  double g(double x, double y) const {
    const auto [along_x, along_y] = gradient(x, y);
    const double U = velocity(x, y), kappa = std::hypot(along_x, along_y) * std::sqrt(1 - U * U), a = contact(x, y);
    return a * StaticTrain::with_density(kappa / a).J0() / kappa;
  }
  double rate(double x, double y) const {
    const auto [along_x, along_y] = gradient(x, y);
    return velocity(x, y) * std::hypot(along_x, along_y);
  }
  double action(double x, double y) const { return g(x, y) * rate(x, y); }
  /// div(g grad U). The contact ratio adds no force, because this is the law of the wave action.
  double action_rate(double x, double y) const {
    return slope_of([&](double at) { return g(at, y) * gradient(at, y)[0]; }, x) +
           slope_of([&](double at) { return g(x, at) * gradient(x, at)[1]; }, y);
  }
};

struct GridErrors {
  double slip, action;
};
GridErrors errors_of_grid(const MovingSlip& motion, std::size_t nx, std::size_t ny) {
  Problem problem;
  problem.left = -1.1, problem.right = 0.9, problem.bottom = -1.3, problem.top = 1;
  if (motion.rough) problem.contact = contact_at;
  const plane::Cells cells{nx, ny, -1.1, -1.3, 2.0 / static_cast<double>(nx), 2.3 / static_cast<double>(ny)};
  const plane::Walls walls(problem, cells);
  plane::GridEquations equations(problem, cells, walls);
  plane::Averages now, rate;
  for (auto* averages : {&now, &rate})
    for (auto* values : {&averages->slip, &averages->action}) values->assign(cells.size(), 0);
  cells.each([&](std::size_t i, std::size_t j, std::size_t cell) {
    now.slip[cell] = MovingSlip::slip(cells.x(i), cells.y(j));
    now.action[cell] = motion.action(cells.x(i), cells.y(j));
  });
  equations.set_known(std::vector<char>(cells.size(), 1));
  equations.find_rates(0, now, rate);
  GridErrors sum{0, 0};
  double count = 0;
  cells.each([&](std::size_t i, std::size_t j, std::size_t cell) {
    if (i < 6 || j < 6 || i + 6 >= nx || j + 6 >= ny || (i + j) % 3 != 0) return;
    sum.slip += std::pow(rate.slip[cell] - motion.rate(cells.x(i), cells.y(j)), 2);
    sum.action += std::pow(rate.action[cell] - motion.action_rate(cells.x(i), cells.y(j)), 2);
    count += 1;
  });
  return {std::sqrt(sum.slip / count), std::sqrt(sum.action / count)};
}

TEST(PlaneManufactured, RatesOfTheGridAreThoseOfTheAveragedEquation) {
  for (const bool rough : {false, true}) {
    const GridErrors coarse = errors_of_grid({rough}, 20, 26), fine = errors_of_grid({rough}, 40, 52);
    EXPECT_LT(fine.slip, 1e-8) << rough;
    EXPECT_LT(fine.action, 5e-5) << rough;
    EXPECT_GT(coarse.slip, 12 * fine.slip) << rough << ": " << coarse.slip << ", " << fine.slip;
    EXPECT_GT(coarse.action, 3.5 * fine.action) << rough << ": " << coarse.action << ", " << fine.action;
  }
}

/// A row of cells along x or y with the slip and the action f(n) of the n-th cell from the middle.
struct RowOfCells {
  static constexpr std::size_t count = 20, middle = count / 2, across = 9;
  static constexpr double h = 0.1;
  bool along_y;
  plane::Cells cells{along_y ? across : count, along_y ? count : across, 0, 0, h, h};
  plane::Averages now{}, rate{};
  bool lines_meet = false;

  template <class Slip, class Action>
  void find(const Slip& slip, const Action& action) {
    const Problem problem;
    const plane::Walls walls(problem, cells);
    plane::GridEquations equations(problem, cells, walls);
    for (auto* averages : {&now, &rate})
      for (auto* values : {&averages->slip, &averages->action}) values->assign(cells.size(), 0);
    cells.each([&](std::size_t i, std::size_t j, std::size_t cell) {
      const double n = static_cast<double>(along_y ? j : i) - static_cast<double>(middle);
      now.slip[cell] = slip(n);
      now.action[cell] = action(n);
    });
    equations.set_known(std::vector<char>(cells.size(), 1));
    equations.find_rates(0, now, rate);
    lines_meet = equations.lines_meet();
  }
  std::size_t at(int n) const {
    const std::size_t along = middle + static_cast<std::size_t>(n);
    return along_y ? cells.at(across / 2, along) : cells.at(along, across / 2);
  }
};

/// Lines meet in a valley of the slip that fills and at a peak that falls, but not on a slope.
TEST(PlaneManufactured, LinesMeetWhereBothSidesMoveTowardsEachOther) {
  for (const bool along_y : {false, true})
    for (const double action : {0.5, -0.5}) {
      const auto meet = [&](const auto& slip) {
        RowOfCells row{.along_y = along_y};
        row.find(slip, [&](double) { return action; });
        return row.lines_meet;
      };
      EXPECT_EQ(meet([](double n) { return 9 + 0.3 * std::fabs(n); }), action > 0);
      EXPECT_EQ(meet([](double n) { return 9 - 0.3 * std::fabs(n); }), action < 0);
      EXPECT_FALSE(meet([](double n) { return 9 + 0.3 * n; }));
      EXPECT_FALSE(meet([](double n) { return 9 - 0.3 * n; }));
    }
}

/// A train with the density k that moves with the velocity U has this wave action.
double action_of(double k, double U) {
  const double kappa = k * std::sqrt(1 - U * U);
  return StaticTrain::with_density(kappa).J0() / kappa * U * k;
}
double velocity_of(double k, double action) {
  double low = -1, high = 1;
  for (int i = 0; i < 60; ++i) {
    const double middle = (low + high) / 2;
    (action_of(k, middle) < action ? low : high) = middle;
  }
  return low;
}

/// A jump of the wave action at a face spreads with the speed of light, which is what no wave exceeds. The flux at the
/// face is g k for the mean of both sides, plus half of the jump.
TEST(PlaneManufactured, AJumpOfTheActionSpreadsWithTheSpeedOfLight) {
  constexpr double k = 1.3, below = 0.2, above = 0.5;
  for (const bool along_y : {false, true}) {
    RowOfCells row{along_y};
    row.find([&](double n) { return 5 + k * RowOfCells::h * n; }, [&](double n) { return n < 0 ? below : above; });
    const auto flux = [&](double action) { return action / velocity_of(k, action); };  // g k = I / U
    const double at_jump = flux((below + above) / 2) + (above - below) / 2;
    EXPECT_NEAR(row.rate.action[row.at(-1)], (at_jump - flux(below)) / RowOfCells::h, 1e-3);
    EXPECT_NEAR(row.rate.action[row.at(0)], (flux(above) - at_jump) / RowOfCells::h, 1e-3);
    EXPECT_NEAR(row.rate.action[row.at(3)], 0, 1e-3);
  }
}

/// A jump of the slope of the slip in a cell adds half of it to the rate of the slip. Lines slower than a tenth of c
/// have a part of it in proportion to their velocity.
TEST(PlaneManufactured, AKinkOfTheSlipIsDampedAsFarAsLinesMove) {
  constexpr double below = 1.1, above = 1.5, k = (below + above) / 2;
  for (const bool along_y : {false, true})
    for (const double U : {0.3, 0.04, 0.0, -0.04}) {
      RowOfCells row{along_y};
      row.find([&](double n) { return 5 + RowOfCells::h * n * (n < 0 ? below : above); },
               [&](double) { return action_of(k, U); });
      const double damped = std::fmin(1, std::fabs(U) / 0.1);
      EXPECT_NEAR(row.rate.slip[row.at(0)], U * k + damped * (above - below) / 2, 1e-3) << U;
    }
}

}  // namespace
