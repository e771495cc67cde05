#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "exact_chains.hpp"
#include "lattice/chain/explicit/explicit_chain.hpp"
#include "lattice/chain/model/initial_train.hpp"
#include "lattice/chain/observe/averages.hpp"
#include "lattice/chain/observe/totals.hpp"
#include "rough_chains.hpp"
#include "slipfront/error.hpp"

namespace {

using namespace slipfront;
using namespace slipfront::chain;
using std::numbers::pi;

/// A chain in doubles, and with phases of 32 bits.
struct Both {
  Both(Problem p, const MotionOf& start) : doubles(p, start), phases((p.phases_of_32_bits = true, p), start) {}
  Both(Problem p, const Motion& start) : doubles(p, start), phases((p.phases_of_32_bits = true, p), start) {}
  void advance(long levels) {
    doubles.advance(levels);
    phases.advance(levels);
  }
  /// The largest difference of u, in turns.
  double difference() const {
    const Levels a = doubles.levels(), b = phases.levels();
    double most = 0;
    for (std::size_t j = 0; j < a.now.size(); ++j) most = std::fmax(most, std::fabs(a.now[j] - b.now[j]));
    return most;
  }

  ExplicitChain doubles, phases;
};

Problem between(double left, double right, End left_end, End right_end, double C) {
  Problem p;
  p.grid = {left, default_spacing, static_cast<std::size_t>(std::lround((right - left) / default_spacing)) + 1};
  p.boundary.left = left_end;
  p.boundary.right = right_end;
  if (C > 0) p.friction = friction::viscous(C);
  return p;
}

/// A step of stress of 0.855 in several tiles. Rounding moves dislocations by some 1e-6 of the length.
TEST(Phases, FollowDoubles) {
  for (const double C : {0.0, 0.5}) {
    constexpr double scale = 300;
    Both both(between(-6 * scale, 6 * scale, End::fixed, End::fixed, C / scale),
              StaticTrain([](double x) { return x < 0 ? 0.855 : 0.0; },
                          between(-6 * scale, 6 * scale, End::fixed, End::fixed, 0).grid));
    const double first = totals(both.phases).energy();
    both.advance(4790);
    EXPECT_LT(both.difference(), 1e-3) << C;  // in turns; a dislocation has passed some 60 sites
    EXPECT_GT(both.difference(), 1e-7) << C;
    const Totals a = totals(both.doubles), b = totals(both.phases);
    EXPECT_EQ(a.dislocations, b.dislocations);
    EXPECT_NEAR(a.charge, b.charge, 1e-9);
    EXPECT_NEAR(b.energy() / a.energy(), 1, 1e-8) << C;
    EXPECT_NEAR(b.momentum / a.momentum, 1, 1e-4) << C;
    const double lost = both.phases.flows().dissipated;
    EXPECT_NEAR((b.energy() + lost) / first, 1, 1e-6) << C;
    if (C > 0) {
      EXPECT_NEAR(lost / both.doubles.flows().dissipated, 1, 1e-5);
    }
  }
}

/// A kink meets each kind of end. A fixed end returns it, and a free end an antikink; around a ring it keeps its turns.
TEST(Phases, MeetEnds) {
  const Motion kink = exact::motion_of(exact::kink(0.6), between(-20, 20, End::free, End::free, 0).grid, 0);
  for (const auto& [left, right] :
       {std::pair{End::free, End::free}, {End::fixed, End::free}, {End::free, End::fixed}}) {
    Both both(between(-20, 20, left, right, 0), kink);
    both.advance(400);
    EXPECT_LT(both.difference(), 1e-5);
    EXPECT_EQ(dislocations(both.phases).size(), 1u);
  }
  Problem ring = between(-20, 20, End::free, End::free, 0);
  ring.grid.sites -= 1;
  ring.boundary = {.periodic = true, .charge = 1};
  Both both(ring, exact::motion_of(exact::kink(0.6), ring.grid, 0));
  both.advance(1000);
  EXPECT_LT(both.difference(), 1e-5);
  EXPECT_GT(both.phases.levels().now.front(), 4);  // it went around more than four times
  EXPECT_EQ(totals(both.phases).charge, 1);
}

/// The lattice has shorter steps, whose second differences are a small part of d2 y.
TEST(Phases, FollowDoublesOnALattice) {
  Problem p = between(-20, 40, End::free, End::fixed, 0.01);
  p.model = Model::lattice;
  Both both(p, exact::motion_of(exact::kink(0.6), p.grid, 0));
  const double first = totals(both.phases).energy();
  both.advance(1000);
  EXPECT_LT(both.difference(), 1e-5);
  EXPECT_NEAR(totals(both.phases).energy() / totals(both.doubles).energy(), 1, 1e-6);
  EXPECT_NEAR((totals(both.phases).energy() + both.phases.flows().dissipated) / first, 1, 1e-4);
}

/// The site at a free end has half a spacing, also where friction takes its energy.
TEST(Phases, WorkAtFreeEndsIsThatOfDoubles) {
  for (const std::size_t count : {9u, 50u, 1501u}) {
    Problem p = cases::problem(count, 17);
    p.phases_of_32_bits = false;
    Both both(p, cases::bumpy(p));
    both.advance(40);
    EXPECT_GT(both.doubles.flows().dissipated, 1e-3) << count;
    EXPECT_NEAR(both.phases.flows().dissipated / both.doubles.flows().dissipated, 1, 1e-5) << count;
  }
}

TEST(Phases, ReturnToTheStartWithoutFriction) {
  Problem p = between(-20, 20, End::free, End::fixed, 0);
  p.phases_of_32_bits = true;
  ExplicitChain forward(p, exact::motion_of(exact::kink(0.6), p.grid, 0));
  forward.advance(1);
  const Levels first = forward.levels();
  forward.advance(300);
  Levels turned = forward.levels();
  std::swap(turned.now, turned.before);
  ExplicitChain back(p, turned);
  back.advance(300);
  EXPECT_EQ(back.levels().now, first.before);
  EXPECT_EQ(back.levels().before, first.now);
}

TEST(Phases, RefuseWhatTheyCannotFollow) {
  Problem p = between(-20, 20, End::free, End::free, 0);
  p.phases_of_32_bits = true;
  Motion fast{std::vector<double>(p.grid.sites, 0.0), std::vector<double>(p.grid.sites, 8.0)};
  EXPECT_THROW(ExplicitChain(p, fast).advance(32), NumericsError);
  Motion far{std::vector<double>(p.grid.sites, 2 * pi * 1.1e6), {}};
  EXPECT_THROW(ExplicitChain(p, far), InputError);
  p.phases_of_32_bits = false;
  EXPECT_NO_THROW(ExplicitChain(p, far).advance(32));
}

TEST(Phases, RefuseOtherForcesAndEnds) {
  const Problem p = between(-20, 20, End::free, End::free, 0.1);
  const auto refused = [&](const auto& change, const std::string& part) {
    Problem other = p;
    other.phases_of_32_bits = true;
    change(other);
    try {
      check(other);
      ADD_FAILURE() << "accepted with " << part;
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what();
    }
  };
  refused([](Problem& q) { q.implicit = true; }, "implicit steps");
  refused([](Problem& q) { q.contact = [](double) { return 0.9; }; }, "a contact ratio");
  refused([](Problem& q) { q.forcing = [](double, double) { return 0.1; }; }, "forces");
  refused([](Problem& q) { q.friction = friction::coulomb(0.1); }, "this friction");
  refused([](Problem& q) { q.friction = q.friction.with("coefficient", cases::between(0.1, 0.2)); }, "this friction");
  refused([](Problem& q) { q.boundary.right = End::absorbing; }, "absorbing ends");
}

}  // namespace
