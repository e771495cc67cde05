#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "exact_chains.hpp"
#include "lattice/chain/explicit/explicit_chain.hpp"
#include "lattice/chain/observe/averages.hpp"
#include "lattice/chain/observe/totals.hpp"
#include "slipfront/text/output/dislocation_paths.hpp"

namespace {

using namespace slipfront;
using output::Dislocation;
using output::Snapshot;
using Numbers = std::vector<std::vector<std::size_t>>;

/// Snapshots of an exact solution at these times.
std::vector<Snapshot> snapshots_of(const exact::Solution& u, const std::vector<double>& times) {
  const chain::Problem problem{.grid = {-20, 0.2, 201}, .boundary = {}, .friction = {}, .forcing = {}, .contact = {}};
  std::vector<Snapshot> all;
  for (const double time : times) {
    const chain::ExplicitChain chain(problem, exact::motion_of(u, problem.grid, time));
    all.emplace_back().time = time;
    all.back().dislocations = chain::dislocations(chain, 0);
  }
  return all;
}

std::vector<Snapshot> snapshots_of(const std::vector<std::vector<Dislocation>>& dislocations, double interval) {
  std::vector<Snapshot> all;
  for (const std::vector<Dislocation>& some : dislocations) {
    all.emplace_back().time = interval * static_cast<double>(all.size());
    all.back().dislocations = some;
  }
  return all;
}

std::vector<double> times(double from, double to, double interval) {
  std::vector<double> all;
  for (double time = from; time < to; time += interval) all.push_back(time);
  return all;
}

TEST(Dislocations, HaveTheLevelThatUPasses) {
  const auto kink = exact::kink(0.5);
  const exact::Solution above = [&](double x, double t) { return kink(x, t) + 6 * std::numbers::pi; };
  const Dislocation at_origin = snapshots_of(kink, {0})[0].dislocations.at(0);
  const Dislocation higher = snapshots_of(above, {4})[0].dislocations.at(0);
  EXPECT_NEAR(higher.x - at_origin.x, 2, 1e-3);
  EXPECT_EQ(higher.level - at_origin.level, 3);
  EXPECT_EQ(higher.sign, at_origin.sign);
}

/// They are invisible for a short time, and their levels change. Each keeps its number and moves only forward.
TEST(Dislocations, KeepTheirNumbersAsTheyPassAntidislocations) {
  for (const double velocity : {0.2, 0.5, 0.9})
    for (const double interval : {0.25, 1.0}) {
      const auto snapshots = snapshots_of(exact::kink_antikink(velocity), times(-10, 10.1, interval));
      const auto paths = output::dislocation_paths(snapshots, {.meeting_time = 4});
      EXPECT_EQ(paths.signs, (std::vector<int>{1, -1}));
      double last[] = {-HUGE_VAL, HUGE_VAL};
      std::size_t seen = 0;
      for (std::size_t i = 0; i < snapshots.size(); ++i)
        for (std::size_t j = 0; j < snapshots[i].dislocations.size(); ++j, ++seen) {
          const std::size_t number = paths.numbers[i][j];
          const double x = snapshots[i].dislocations[j].x;
          EXPECT_TRUE(number == 0 ? x > last[0] : x < last[1]) << velocity << " t = " << snapshots[i].time;
          last[number] = x;
        }
      EXPECT_GT(seen, snapshots.size());
    }
}

TEST(Dislocations, KeepTheirNumbersAsTheyBounce) {
  const auto snapshots = snapshots_of(exact::kink_kink(0.5), times(-10, 10.1, 4));
  for (const auto& numbers : output::dislocation_paths(snapshots, {}).numbers)
    EXPECT_EQ(numbers, (std::vector<std::size_t>{0, 1}));
}

/// From one snapshot to the next the train moves by more than the distance of two dislocations. One comes in, one
/// leaves.
TEST(Dislocations, OfOneSignHaveTheNumbersOfTheirLevels) {
  const auto snapshots = snapshots_of({{{0, 1, 2}, {1, 1, 1}, {2, 1, 0}}, {{1.5, 1, 3}, {2.5, 1, 2}, {3.5, 1, 1}}}, 2);
  EXPECT_EQ(output::dislocation_paths(snapshots, {}).numbers, (Numbers{{0, 1, 2}, {3, 0, 1}}));
}

/// Each dislocation passes two antidislocations between two snapshots. Levels and distances would connect the wrong
/// ones.
TEST(Dislocations, OfTwoSignsKeepTheirOrder) {
  const auto snapshots = snapshots_of(
      {{{0, 1, 1}, {1, 1, 0}, {2, -1, 0}, {3, -1, 1}}, {{0.5, -1, 2}, {0.9, -1, 3}, {2.1, 1, 3}, {2.9, 1, 2}}}, 3);
  EXPECT_EQ(output::dislocation_paths(snapshots, {}).numbers, (Numbers{{0, 1, 2, 3}, {2, 3, 0, 1}}));
}

/// Two dislocations pass an antidislocation while a third one comes in, and their levels change. The first one is then
/// where the second one would be by its level.
TEST(Dislocations, OfTwoSignsKeepTheirVelocityAsOneComesIn) {
  const auto snapshots = snapshots_of({{{0, 1, 1}, {2, 1, 0}, {6.5, -1, 0}},
                                       {{1.8, 1, 1}, {3.8, 1, 0}, {4.7, -1, 0}},
                                       {{1.7, 1, 2}, {2.9, -1, 2}, {3.6, 1, 2}, {5.6, 1, 1}}},
                                      2);
  EXPECT_EQ(output::dislocation_paths(snapshots, {}).numbers, (Numbers{{0, 1, 2}, {0, 1, 2}, {3, 2, 0, 1}}));
}

/// A pair begins between two dislocations and ends again.
TEST(Dislocations, NewPairsHaveNewNumbers) {
  const std::vector<Dislocation> without = {{0, 1, 1}, {9, 1, 0}}, pair = {{0, 1, 1}, {4, -1, 1}, {5, 1, 1}, {9, 1, 0}};
  const auto snapshots = snapshots_of({without, pair, without, without, pair}, 1);
  EXPECT_EQ(output::dislocation_paths(snapshots, {}).numbers,
            (Numbers{{0, 1}, {0, 2, 3, 1}, {0, 1}, {0, 1}, {0, 4, 5, 1}}));
}

/// Around a ring of two dislocations u falls by 4 pi, so a dislocation that passes the end returns two levels higher.
TEST(Dislocations, KeepTheirNumbersAroundARing) {
  const auto snapshots = snapshots_of({{{1, 1, 1}, {6, 1, 0}}, {{4, 1, 1}, {9, 1, 0}}, {{2, 1, 2}, {7, 1, 1}}}, 3);
  const auto paths = output::dislocation_paths(snapshots, {.ring_length = 10});
  EXPECT_EQ(paths.numbers, (Numbers{{0, 1}, {0, 1}, {1, 0}}));
}

/// The outermost dislocations are where the totals say, also exactly on a site and on the seam of a ring.
TEST(Dislocations, AreOutermostWhereTotalsSay) {
  using namespace slipfront::chain;
  for (const double place : {0.0, 0.1, -0.13, 19.9, 19.99})
    for (const int sign : {1, -1}) {
      Problem p{.grid = {-20, 0.2, 200}, .boundary = {}, .friction = {}, .forcing = {}, .contact = {}};
      p.boundary = {.periodic = true, .charge = 3 * sign};
      Motion start;
      for (std::size_t j = 0; j < p.grid.sites; ++j) {
        double u = 0;  // a sum of kinks and of their images around the ring
        for (const double x : {place, place - 10, place - 25})
          for (int around = -3; around <= 3; ++around) u += 4 * std::atan(std::exp(x + 40 * around - p.grid.x(j)));
        start.u.push_back(sign * u);
      }
      const ExplicitChain chain(p, start);
      const Totals t = totals(chain);
      const auto all = dislocations(chain);
      EXPECT_EQ(t.dislocations, static_cast<long>(all.size()));
      ASSERT_TRUE(t.first_site && t.last_site) << place;
      const auto first = dislocations_after(chain, *t.first_site, chain.time()),
                 last = dislocations_after(chain, *t.last_site, chain.time());
      ASSERT_FALSE(first.empty() || last.empty()) << place;
      EXPECT_EQ(first.front().x, all.front().x) << place;
      EXPECT_EQ(last.back().x, all.back().x) << place;
    }
}

}  // namespace
