
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "lattice/chain/explicit/explicit_chain.hpp"
#include "lattice/chain/model/initial_train.hpp"
#include "lattice/chain/observe/averages.hpp"
#include "slipfront/error.hpp"
#include "slipfront/theory/train.hpp"

namespace {

using namespace slipfront;
using namespace slipfront::chain;
using std::numbers::pi;

/// A uniform train that moves between free ends. The ends are so far away that they do not affect it yet.
ExplicitChain moving_train(double U, double stress) {
  const State state{std::atanh(U), train::psi_of_stress(stress)};
  Problem problem;
  problem.grid = {-100, 0.25, 801};
  Motion motion;
  for (std::size_t j = 0; j < problem.grid.sites; ++j) {
    // The fields of one period, centred at a dislocation (u = pi). u falls by one turn from each dislocation to the
    // next.
    const double period = train::spacing(state), x = problem.grid.x(j), turns = std::round(x / period);
    const train::Fields f = train::fields(state, x - turns * period);
    motion.u.push_back(f.u - 2 * pi * turns);
    motion.velocity.push_back(f.w);
  }
  return {problem, motion};
}

/// The position of the window must not matter. With a box average of the same width, the ripple is a hundred times the
/// tolerance.
TEST(ChainSmooth, AverageOfATrainAgreesWithTheoryForAnyWindow) {
  const double U = 0.3, stress = 0.855;
  const ExplicitChain chain = moving_train(U, stress);
  const State state{std::atanh(U), train::psi_of_stress(stress)};
  const train::Averages exact = train::averages(state);
  for (double x = 0; x < 8; x += 0.7) {
    const SmoothAverage a = smooth_average(chain, x, 60, chain.time());
    EXPECT_NEAR(a.velocity, exact.W, 1e-3 * exact.W) << x;
    EXPECT_NEAR(a.stress, exact.k, 1e-3 * exact.k) << x;
    EXPECT_NEAR(a.energy, exact.H, 1e-3 * exact.H) << x;
    EXPECT_NEAR(energy_of_train(exact.k, exact.W), exact.H, 1e-12 * exact.H);
  }
  EXPECT_THROW(smooth_average(chain, 0, 0, 0), InputError);
  EXPECT_THROW(smooth_average(chain, 1000, 8, 0), InputError);
}

/// The site at a fixed end has zero velocity at any position relative to the dislocations.
TEST(ChainSmooth, AFixedEndDoesNotMove) {
  for (const double left : {-100.0, -101.3, -102.9}) {
    Problem problem;
    problem.grid = {left, 0.25, 801};
    problem.boundary = {.left = End::fixed, .right = End::fixed};
    ExplicitChain chain(problem, static_train([](double x) { return x < 0 ? 0.855 : 0.0; }, problem.grid));
    chain.advance(64);
    const Window w = chain.window(0, problem.grid.sites);
    EXPECT_EQ(w.velocity.front(), 0) << left;
    EXPECT_EQ(w.velocity.back(), 0) << left;
  }
}

}  // namespace
