#include <gtest/gtest.h>

#include "exact.hpp"

namespace {

using namespace slipfront;
using namespace slipfront::chain;
using modulation::FrictionLaw;

Motion bumpy(const Problem& p) {
  Motion m;
  const double turns = 2 * std::numbers::pi * static_cast<double>(p.boundary.charge);
  const double length = p.grid.spacing * static_cast<double>(p.grid.sites);
  for (std::size_t j = 0; j < p.grid.sites; ++j) {
    const double s = (p.grid.x(j) - p.grid.left) / length;
    m.u.push_back(1000 - turns * s + 0.3 * std::sin(7 * s));
    m.velocity.push_back(0.1 * std::cos(90 * s));
  }
  return m;
}

Problem problem(std::size_t sites, int kind) {
  Problem p{.grid = {-10, 0.4, sites},
            .model = Model::sine_gordon,
            .boundary = {End::free, End::absorbing, false, 0},
            .friction = {},
            .forcing = {},
            .contact = {}};
  if (kind == 1) p.boundary = {.periodic = true, .charge = sites < 20 ? 1 : 3};
  if (kind == 2) p.boundary = {End::fixed, End::free, false, 0};
  if (kind == 2 || kind == 1) p.friction = {FrictionLaw::viscous, 0.3};
  if (kind == 3) {
    p.boundary = {.periodic = true, .charge = sites < 20 ? 1 : 2};
    p.friction = {FrictionLaw::power, 0.2, 1.5};
    p.forcing = [](double x, double t) { return 0.1 * std::sin(0.1 * x + t); };
    p.contact = [](double x) { return 1 + 0.2 * std::cos(0.3 * x); };
  }
  if (kind == 4) {
    p.model = Model::lattice;
    p.boundary = {End::fixed, End::absorbing, false, 0};
    p.friction = {FrictionLaw::coulomb, 0.02};
  }
  return p;
}

void expect_same(const Levels& a, const Levels& b, const std::string& what) {
  EXPECT_EQ(a.level, b.level);
  for (std::size_t j = 0; j < a.now.size(); ++j) {
    ASSERT_EQ(a.now[j], b.now[j]) << what << ", site " << j;
    ASSERT_EQ(a.before[j], b.before[j]) << what << ", site " << j;
  }
}

/// Threads, tiles and the way that steps are bundled change no bits; nor does a stop.
TEST(ChainBits, DoNotDependOnThreadsTilesOrStops) {
  for (const std::size_t sites : {9u, 50u, 130u, 1501u, 12000u})
    for (int kind = 0; kind < (sites > 10000 ? 2 : 5); ++kind) {  // the longest are worth true threads
      const Problem p = problem(sites, kind);
      const Motion start = bumpy(p);
      const std::string what = std::to_string(sites) + " sites, kind " + std::to_string(kind);
      const auto run = [&](const Execution& e) {
        chain::Chain c(p, start, e);
        c.advance(301);
        return c.levels();
      };
      const Levels one = run({});
      for (const double z : one.now) ASSERT_TRUE(std::fabs(z) < 1e3) << what;
      expect_same(one, run({.threads = 2}), what + ", two threads");
      expect_same(one, run({.threads = 3, .tile = 104}), what + ", three threads, small tiles");
      expect_same(one, run({.threads = 1, .tile = 200}), what + ", tiles of 200");
      chain::Chain c(p, start, {});
      for (const long some : {1, 7, 32, 33, 60}) c.advance(some);
      chain::Chain again(p, c.levels(), {.threads = 2, .tile = 88});
      again.advance(301 - c.level());
      expect_same(one, again.levels(), what + ", stopped");
    }
}

}  // namespace
