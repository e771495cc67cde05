#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "exact_chains.hpp"
#include "lattice/chain/explicit/explicit_chain.hpp"
#include "lattice/chain/explicit/levels/kernel.hpp"
#include "lattice/chain/model/initial_train.hpp"
#include "lattice/chain/observe/averages.hpp"
#include "lattice/chain/observe/totals.hpp"
#include "slipfront/error.hpp"
#include "slipfront/theory/train.hpp"

namespace {

using namespace slipfront;
using namespace slipfront::chain;
using std::numbers::pi;

Problem line(double left, double right, double h) {
  return {.grid = {left, h, static_cast<std::size_t>(std::lround((right - left) / h)) + 1},
          .model = Model::sine_gordon,
          .boundary = {},
          .friction = {},
          .forcing = {},
          .contact = {}};
}

/// The dislocation density follows the stress, and a uniform train has the fields of Eq. (4).
TEST(ChainInitial, TrainFollowsTheStress) {
  const Grid grid{-200, 0.25, 1601};
  const auto stress = [](double x) { return x < -150 || x > 100 ? 0.0 : 0.6 + 0.4 * std::tanh(x / 40); };
  const Motion m = static_train(stress, grid);
  const double charge = (40 * std::log(std::cosh(2.5) / std::cosh(150 / 40.0)) * 0.4 + 0.6 * 250) / (2 * pi);
  EXPECT_EQ(m.u.front(), 2 * pi * std::round(charge));
  EXPECT_EQ(m.u.back(), 0);
  for (std::size_t j = 1; j < m.u.size(); ++j) ASSERT_LE(m.u[j], m.u[j - 1] + 1e-12) << grid.x(j);

  const Motion uniform = static_train([](double x) { return x < 0 ? 0.855 : 0.0; }, grid);
  const double spacing = 2 * pi / 0.855;
  for (const double x : {-100.0, -31.5, -2.0}) {
    const auto j = static_cast<std::size_t>(std::lround((x - grid.left) / grid.spacing));
    // The last dislocation is half a spacing away from the edge of the train at x = 0.
    const auto exact = [&] {
      double low = 1e-3, high = 1;
      for (int i = 0; i < 100; ++i) (train::stress_at_rest((low + high) / 2) < 0.855 ? low : high) = (low + high) / 2;
      return train::fields({0, low}, x + spacing / 2).u;
    }();
    EXPECT_NEAR(uniform.u[j], exact, 1e-9) << x;
  }
  EXPECT_THROW(static_train([](double) { return -1.0; }, grid), InputError);
}

/// A train that is created piece by piece, in any order, has the bits of one that is created as a whole.
TEST(ChainInitial, PiecesHaveTheBitsOfTheWhole) {
  const Grid grid{-2000, 0.4, 10000};
  const auto stress = [](double x) {
    return x < -1500 || x > 100 || (x > -800 && x < -700) ? 0.0 : 0.6 + 0.4 * std::tanh(x / 40);
  };
  for (const bool whole : {false, true}) {
    const StaticTrain train(stress, grid, whole);
    const Motion all = static_train(stress, grid, whole);
    for (const std::size_t begin : {9000u, 0u, 4095u, 4096u, 1249u, 3000u, 9999u}) {
      const std::size_t end = std::min<std::size_t>(begin + 5001, grid.sites);
      const Motion some = train(begin, end);
      ASSERT_EQ(some.u.size(), end - begin);
      for (std::size_t j = begin; j < end; ++j) ASSERT_EQ(some.u[j - begin], all.u[j]) << begin << " " << j;
    }
  }
}

/// At a jump of the stress, u is as smooth as within either train, for any length of the right train.
TEST(ChainInitial, JumpsOfStressLieBetweenDislocations) {
  for (const double right : {100.0, 101.3, 103.7, 106.1, 110.9}) {
    const Grid grid{-100, 0.25, static_cast<std::size_t>((right + 100) / 0.25) + 1};
    const Motion m = static_train([](double x) { return x < 0 ? 0.855 : 0.3; }, grid);
    for (std::size_t j = 1; j < m.u.size(); ++j) {
      ASSERT_LE(m.u[j], m.u[j - 1] + 1e-12) << grid.x(j);
      ASSERT_LT(m.u[j - 1] - m.u[j], 2.1 * 0.25) << grid.x(j);  // a dislocation is no steeper
    }
  }
}

/// A train at rest stays at rest, because the initial state is an equilibrium to the order of the grid.
TEST(ChainInitial, UniformTrainStaysAtRest) {
  Problem p = line(0, 20 * 2 * pi, 20 * 2 * pi / 320);
  p.grid.sites = 320;
  p.boundary = {.periodic = true, .charge = 17};
  const Motion m = static_train([](double) { return 17.0 / 20; }, p.grid, true);
  chain::ExplicitChain run(p, m);
  run.advance_to(100);
  const Window w = run.window(0, 320);
  for (std::size_t j = 0; j < 320; ++j) ASSERT_NEAR(w.u[j], m.u[j], 2e-3) << j;
}

/// A train at rest also stays at rest for other contact ratios a. Its psi follows from the stress in local units, k /
/// a.
TEST(ChainInitial, UniformTrainStaysAtRestInStrongerOrWeakerContact) {
  for (const double a : {0.7, 1.3}) {
    Problem p = line(0, 20 * 2 * pi, 20 * 2 * pi / 480);
    p.grid.sites = 480;
    p.boundary = {.periodic = true, .charge = 17};
    p.contact = [a](double) { return a; };
    const Motion m = static_train([](double) { return 17.0 / 20; }, p.grid, true, p.contact);
    chain::ExplicitChain run(p, m);
    run.advance_to(100);
    const Window w = run.window(0, 480);
    for (std::size_t j = 0; j < 480; ++j) ASSERT_NEAR(w.u[j], m.u[j], 2e-3) << j;
  }
}

/// Trains with the same J = (4 / pi) a cosh(psi) E are in equilibrium with each other on a slope of a(x), for any
/// stress (docs/theory/6_contact.md). Such a train hardly moves. A train that is created with psi of k, without a,
/// moves at once.
TEST(ChainInitial, TrainInEquilibriumOnASlopeOfContactStaysAtRest) {
  const double length = 300;
  Problem p = line(0, length, 0.25);
  p.grid.sites -= 1;  // a ring
  const auto a = [length](double x) { return 1 + 0.05 * std::sin(2 * pi * x / length); };
  const double J0 = train::averages(train::at_rest(1.2)).J;
  // The stress at x is a k(psi), for the psi that satisfies a J(psi) = J0.
  const auto stress = [&](double x) {
    double low = 1e-3, high = 3;
    for (int i = 0; i < 60; ++i) {
      const double middle = (low + high) / 2;
      (a(x) * train::averages(State{0, middle}).J < J0 ? low : high) = middle;
    }
    return a(x) * train::stress_at_rest(low);
  };
  const auto drift = [&](const std::function<double(double)>& contact_of_train) {
    const StaticTrain train(stress, p.grid, true, contact_of_train);
    p.contact = a;
    const double fall = train(0, 1).u[0] - train(p.grid.sites - 1, p.grid.sites).u[0];
    p.boundary = {.periodic = true, .charge = std::lround(fall / (2 * pi))};
    chain::ExplicitChain run(p, train(0, p.grid.sites));
    double moving = 0;
    for (int i = 0; i < 10; ++i) {
      run.advance(20);
      moving = std::fmax(moving, totals(run).kinetic / totals(run).energy());
    }
    return moving;
  };
  const double right = drift(a), wrong = drift({});
  EXPECT_LT(right, 1e-5);
  EXPECT_GT(wrong, 30 * right);
}

/// The grid of the continuum equation also pins a dislocation, up to its Peierls-Nabarro barrier (40 pi / h^2)
/// exp(-pi^2 / h). The barrier is 2.5e-5 at h = 0.6 (docs/chain.md).
TEST(ChainPhysics, GridPinsADislocationBelowItsBarrier) {
  const double h = 0.6, barrier = 40 * pi / (h * h) * std::exp(-pi * pi / h);
  const auto moved = [&](double share) {
    Problem p = line(-24, 24, h);
    p.friction = friction::viscous(0.02);
    p.forcing = [=](double, double t) { return share * barrier * std::fmin(t / 1000, 1.0); };  // slowly, from rest
    p.boundary = {End::fixed, End::fixed, false, 0};
    chain::ExplicitChain run(p, exact::motion_of(exact::kink(0), p.grid, 0));
    run.advance_to(3000);
    return std::fabs(dislocations(run).at(0).x);
  };
  EXPECT_LT(
      moved(0.9),
      0.75 * h);  // from a site to the middle between two sites, where it is pinned, and half way to the next middle
  EXPECT_GT(moved(1.2), h);
}

/// A lattice pins a dislocation until the force reaches the Peierls-Nabarro threshold. On the grid of the continuum
/// equation, the threshold is a thousand times lower.
TEST(ChainPhysics, LatticePinsDislocations) {
  const auto moved = [](double A, double F, Model model) {
    Problem p = line(-24, 24, A);
    p.model = model;
    p.friction = friction::viscous(0.3);
    p.forcing = [F](double, double t) { return F * std::fmin(t / 40, 1.0); };  // slowly, from rest
    chain::ExplicitChain run(
        p, exact::motion_of([](double x, double) { return 4 * std::atan(std::exp(-x - 0.5)); }, p.grid, 0));
    run.advance_to(60);
    const double before = dislocations(run).at(0).x;
    run.advance_to(160);
    const auto after = dislocations(run);
    return after.empty() ? 100.0 : after[0].x - before;
  };
  EXPECT_LT(std::fabs(moved(1.2, 0.005, Model::lattice)), 0.1);  // threshold about 0.02 for A = 1.2
  EXPECT_GT(moved(1.2, 0.06, Model::lattice), 3);
  EXPECT_GT(moved(0.5, 0.005, Model::lattice), 0.8);
  EXPECT_GT(moved(0.5, 0.005, Model::sine_gordon), 0.8);
}

/// Coulomb friction stops a chain as long as the force is below f. A power law with exponent 1 acts like viscous
/// friction.
TEST(ChainPhysics, CoulombFrictionSticksAndAPowerOfOneIsViscous) {
  Problem p = line(-20, 20, 0.4);
  p.friction = friction::coulomb(0.05);
  Motion rest;
  rest.u.assign(p.grid.sites, 0.03);  // sin u < f
  chain::ExplicitChain stuck(p, rest);
  stuck.advance_to(50);
  for (const double u : stuck.window(0, p.grid.sites).u) EXPECT_NEAR(u, 0.03, 1e-3);

  Problem viscous = line(-20, 20, 0.1), power = viscous;
  viscous.friction = friction::viscous(0.2);
  power.friction = friction::power(0.2, 1);
  const Motion kink = exact::motion_of(exact::kink(0.5), viscous.grid, 0);
  chain::ExplicitChain a(viscous, kink), b(power, kink);
  a.advance_to(10);
  b.advance_to(10);
  EXPECT_NEAR(dislocations(a).at(0).x, dislocations(b).at(0).x, 2e-3);
}

/// With a uniform contact ratio a, scaling x and t by a gives the equation with a = 1.
TEST(ChainPhysics, UniformContactIsAScale) {
  Problem plain = line(-20, 20, 0.2), strong = line(-10, 10, 0.1);
  strong.contact = [](double) { return 2.0; };
  const auto u = exact::kink(0.4);
  chain::ExplicitChain a(plain, exact::motion_of(u, plain.grid, 0));
  chain::ExplicitChain b(strong, exact::motion_of([u](double x, double t) { return u(2 * x, 2 * t); }, strong.grid, 0));
  a.advance(60);
  b.advance(60);
  EXPECT_NEAR(a.time(), 2 * b.time(), 1e-12);
  const Window wa = a.window(0, 201), wb = b.window(0, 201);
  for (std::size_t j = 0; j < 201; ++j) EXPECT_NEAR(wa.u[j], wb.u[j], 1e-8);
  EXPECT_EQ(wb.contact_squared[7], 4);
}

/// A dislocation leaves through an absorbing end, which reflects little energy.
TEST(ChainPhysics, AbsorbingEndLetsDislocationsOut) {
  Problem p = line(-15, 15, 0.25);
  p.boundary = {End::absorbing, End::absorbing, false, 0};
  chain::ExplicitChain run(p, exact::motion_of(exact::kink(0.9), p.grid, 0));
  const double first = totals(run).energy();
  run.advance_to(40);
  EXPECT_EQ(dislocations(run).size(), 0u);
  EXPECT_LT(totals(run).energy(), 0.05 * first);
}

/// The time shift when one dislocation passes through another is 2 ln(U) / (gamma U), to 1e-6 on a fine grid.
TEST(ChainPhysics, TimeShiftOfACollisionAgreesWithTheExactSolution) {
  const double U = 0.6, g = 1 / std::sqrt(1 - U * U);
  const Problem p = line(-25, 25, 0.02);
  const auto u = exact::kink_kink(U);
  chain::ExplicitChain run(p, exact::motion_of(u, p.grid, -12));
  run.advance_to(24);
  // The two repel. Long after the collision, they are at g (x -+ U t) = -+ ln U.
  const double t = run.time() - 12;
  const auto found = dislocations(run);
  ASSERT_EQ(found.size(), 2u);
  // At a finite distance, u = -pi and pi exactly at U sinh(g x) = cosh(g U t).
  const double exact = std::asinh(std::cosh(g * U * t) / U) / g;
  EXPECT_NEAR(found[1].x, exact, 1e-6);
  EXPECT_NEAR(found[0].x, -exact, 1e-6);
  const double shift = found[1].x - U * t, limit = -std::log(U) / g;
  EXPECT_NEAR(shift, limit, 1e-6 + std::fabs(exact - U * t - limit));
}

void refused(const Problem& p, const Motion& m, const std::string& what) {
  try {
    chain::ExplicitChain run(p, m);
    ADD_FAILURE() << "accepted: " << what;
  } catch (const InputError& e) {
    EXPECT_NE(std::string(e.what()).find(what), std::string::npos) << e.what();
  }
}

TEST(ChainInput, RejectsInvalidNumbers) {
  const Problem good = line(-20, 20, 0.4);
  const Motion kink = exact::motion_of(exact::kink(0), good.grid, 0);
  Problem p = good;
  p.grid.spacing = 0.9;
  refused(p, kink, "sites to the width of a dislocation");
  p = good;
  p.contact = [](double) { return 3.0; };
  refused(p, kink, "0.833333 sites to the width");
  p = good;
  p.step = 0.41;
  refused(p, kink, "unstable");
  p.model = Model::lattice;
  refused(p, kink, "unstable");
  p = good;
  p.grid.sites = std::size_t{1} << 40;
  refused(p, kink, "GB");
  p = good;
  p.boundary = {.periodic = true, .charge = 2};
  refused(p, kink, "charge");
  p = good;
  p.grid.sites = 90;
  refused(p, kink, "does not fit the grid");
  refused(good, exact::motion_of([](double x, double) { return -6 * x; }, good.grid, 0), "too coarse");
  EXPECT_THROW(average(chain::ExplicitChain(good, kink), 19, 4, 0), InputError);
  EXPECT_THROW(chain::ExplicitChain(good, Levels{0, {1, 2}, {1, 2}}), InputError);
}

TEST(ChainInput, StopsAtADisplacementThatIsNotANumber) {
  Problem p = line(-20, 20, 0.4);
  p.forcing = [](double x, double t) { return t > 3 && x > 5 ? std::numeric_limits<double>::quiet_NaN() : 0.0; };
  chain::ExplicitChain run(p, exact::motion_of(exact::kink(0), p.grid, 0));
  try {
    run.advance_to(10);
    ADD_FAILURE();
  } catch (const NumericsError& e) {
    EXPECT_NE(std::string(e.what()).find("t = 3.1"), std::string::npos) << e.what();
    EXPECT_NE(std::string(e.what()).find("site"), std::string::npos) << e.what();
  }
}

}  // namespace
