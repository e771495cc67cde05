// For Gamma = C t >> 1, Eqs. (7) reduce to nonlinear diffusion (docs/theory/3_modulation.md 3.5). Its solution from a
// step next to the empty side depends only on q / sqrt(t / C). We solve it here as an ordinary differential equation,
// independently of the library's scheme.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "averages/pulse/solver.hpp"
#include "slipfront/math/elliptic.hpp"
#include "slipfront/theory/train.hpp"

namespace {

using namespace slipfront;
using namespace slipfront::pulse;
using friction::Closure;
using std::numbers::pi;

/// With zeta = q sqrt(C / t) and U = g / sqrt(C t), M = 8 U cosh psi E = -p_q / C and l_t = U_q become
///     d zeta / d psi = -sinh psi / (2 E g)        d g / d psi = -(zeta / 2) dl / d psi
/// from the edge (psi = 0, zeta = 0, g = g0) to where g = 0 far behind it. x = (2 g + zeta l) sqrt(t / C), as x starts
/// from l q. With the paper's closure C is C pi^2 / (4 E K).
struct Diffusion {
  Closure closure;
  struct Point {
    double psi, zeta, g;
  };

  Point slope(const Point& at) const {
    const elliptic::AtPsi e = elliptic::at_psi(at.psi);
    const double K_slope = -e.K * e.above_m1 / e.s;
    const double l_slope = 2 * (K_slope - e.K * e.s) / std::cosh(at.psi);
    const double understated = closure == Closure::paper ? 4 * e.E * e.K / (pi * pi) : 1;
    return {1, -understated * std::sinh(at.psi) / (2 * e.E * at.g), -at.zeta / 2 * l_slope};
  }

  /// Integrates from the edge with speed g0 until psi, or until g = 0. Steps shrink towards psi, where zeta diverges.
  std::vector<Point> from_edge(double g0, double psi) const {
    constexpr int steps = 16000;
    std::vector<Point> path{{1e-9 * psi, 0, g0}};
    for (int i = 0; i < steps; ++i) {
      const Point p = path.back();
      const auto moved = [&](const Point& d, double by) {
        return Point{p.psi + by, p.zeta + d.zeta * by, p.g + d.g * by};
      };
      const double step = psi * (1 - std::pow(1 - (i + 1.0) / steps, 4)) - p.psi;
      const Point a = slope(p), b = slope(moved(a, step / 2)), c = slope(moved(b, step / 2)), d = slope(moved(c, step));
      path.push_back({p.psi + step, p.zeta + step * (a.zeta + 2 * b.zeta + 2 * c.zeta + d.zeta) / 6,
                      p.g + step * (a.g + 2 * b.g + 2 * c.g + d.g) / 6});
      if (!(path.back().g > 0)) break;
    }
    return path;
  }

  /// W(0) sqrt(C t): k g at x = 0.
  double slip_velocity(double stress) const {
    const double psi = train::psi_of_stress(stress);
    double slow = 1e-6, fast = 10;
    for (int i = 0; i < 100; ++i) {
      const double middle = std::sqrt(slow * fast);
      (from_edge(middle, psi).back().g > 0 ? fast : slow) = middle;
    }
    const std::vector<Point> path = from_edge(fast, psi);
    const auto x = [](const Point& p) { return 2 * p.g + p.zeta * 2 * pi / train::stress_at_rest(p.psi); };
    const auto W = [](const Point& p) { return p.g * train::stress_at_rest(p.psi); };
    for (std::size_t i = 1; i < path.size(); ++i)
      if (x(path[i]) <= 0) {
        const double share = x(path[i - 1]) / (x(path[i - 1]) - x(path[i]));
        return W(path[i - 1]) + share * (W(path[i]) - W(path[i - 1]));
      }
    return NAN;
  }
};

struct Computed {
  double W;  ///< W(0) sqrt(C t)
  long steps;
};
Computed computed(double gamma, Closure closure, int cells) {
  const double reach = 20 / std::sqrt(gamma);
  Solver s({.stress = [](double x) { return x < 0 ? 0.855 : 0.0; },
            .forcing = {},
            .friction = friction::viscous(gamma / (2 * pi), closure),
            .left = -reach,
            .right = reach,
            .cells = cells});
  s.advance_to(2 * pi);
  return {train::averages(state_at(s.view(), 0)).W * std::sqrt(gamma), s.cells().steps};
}

TEST(Diffusion, IsTheLimitOfStrongFriction) {
  for (const Closure closure : {Closure::consistent, Closure::paper}) {
    const double limit = Diffusion{closure}.slip_velocity(0.855);
    const double coarse = std::fabs(computed(1e8, closure, 100).W / limit - 1);
    const double fine = std::fabs(computed(1e8, closure, 400).W / limit - 1);
    EXPECT_LT(coarse, 2e-4);
    EXPECT_LT(fine, coarse / 8);  // second order would be 16; the steps have errors too
    EXPECT_LT(fine, 1e-5);
  }
}

TEST(Diffusion, ErrorFallsAsOneOverGamma) {
  const double limit = computed(1e8, Closure::consistent, 200).W;  // with the same number of cells
  double last = 0;
  for (const double gamma : {1e2, 1e3, 1e4, 1e5}) {
    const double error = std::fabs(computed(gamma, Closure::consistent, 200).W / limit - 1);
    EXPECT_LT(error, 0.6 / gamma);
    EXPECT_TRUE(last == 0 || error < last / 4) << gamma;
    last = error;
  }
}

TEST(Diffusion, SmoothStepNextToTheEmptySideTendsToTheStep) {
  const double C = 1e4, reach = 20 / std::sqrt(2 * pi * C);
  const auto slip = [&](double width) {
    Solver s({.stress =
                  [=](double x) {
                    const double k = 0.855 * (width > 0 ? (1 - std::tanh(x / width)) / 2 : x < 0 ? 1 : 0);
                    return k < train::smallest_stress ? 0 : k;
                  },
              .forcing = {},
              .friction = friction::viscous(C),
              .left = -reach,
              .right = reach,
              .corner = width > 0 ? HUGE_VAL : 0,
              .cells = 200});
    s.advance_to(2 * pi);
    return s.slip_at(s.view(), 0);
  };
  EXPECT_NEAR(slip(reach / 1000) / slip(0), 1, 2e-2);
}

TEST(Diffusion, StepsDoNotGrowWithGamma) {
  const long weak = computed(1e3, Closure::consistent, 100).steps;
  for (const double gamma : {1e4, 1e6, 1e8})
    EXPECT_LT(computed(gamma, Closure::consistent, 100).steps,
              static_cast<double>(weak) * std::log(gamma) / std::log(1e3));
}

Problem steep_at_rest(double exponent, double coefficient, double stress, int cells) {
  return {.stress = [=](double x) { return 0.3 + (stress - 0.3) * (1 - std::tanh(x)) / 2; },
          .forcing = {},
          .friction = friction::power(coefficient, exponent),
          .left = -5,
          .right = 5,
          .corner = HUGE_VAL,
          .cells = cells};
}

/// Friction times are shorter than any step here, and the slope of friction at rest does not predict the force at the
/// end of a step. A solver that relied on it would take implicit steps of 1e-36.
TEST(SteepAtRest, NeedsFewSteps) {
  for (const double exponent : {0.1, 0.2, 0.3, 0.5})
    for (const int cells : {4, 40}) {
      Problem p = steep_at_rest(exponent, 0.02, 0.24, cells);
      p.stress = [](double x) { return 0.12 * (1 - std::tanh(x)) < 0.0045 ? 0 : 0.12 * (1 - std::tanh(x)); };
      Solver s(p);
      s.advance_to(0.05);
      EXPECT_LT(s.cells().steps, 60) << exponent << " " << cells;
      EXPECT_TRUE(std::isfinite(s.view().states[0].phi));
    }
}

/// The number of steps that the error control chooses gives the same result as many more steps.
TEST(SteepAtRest, LongStepsAreAsAccurateAsShortOnes) {
  Problem p = steep_at_rest(0.5, 50, 0.855, 100);
  Solver free(p);
  free.advance_to(6);
  EXPECT_LT(free.cells().steps, 30);
  p.longest_step = 6.0 / 400;
  Solver small(p);
  small.advance_to(6);
  EXPECT_GE(small.cells().steps, 400);
  const auto at = [](const Solver& s) { return averages_of(s.view(), state_at(s.view(), 0), 0).W; };
  EXPECT_NEAR(at(free) / at(small), 1, 1e-5);
  EXPECT_NEAR(free.slip_at(free.view(), 0) / small.slip_at(small.view(), 0), 1, 1e-5);
  EXPECT_NEAR(free.dissipated() / small.dissipated(), 1, 1e-5);
}

}  // namespace
