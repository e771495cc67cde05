#include <gtest/gtest.h>

#include "exact_chains.hpp"
#include "lattice/chain/explicit/explicit_chain.hpp"

namespace {

using namespace slipfront;
using namespace slipfront::chain;

Problem on_grid(double reach, double h) {
  return {.grid = {-reach, h, static_cast<std::size_t>(std::lround(2 * reach / h)) + 1},
          .model = Model::sine_gordon,
          .boundary = {},
          .friction = {},
          .forcing = {},
          .contact = {}};
}

struct Case {
  const char* name;
  exact::Solution u;
  double from, to;
};

/// Fourth order for every exact solution, from the start by (u, u_t) on.
TEST(Chain, FollowsExactSolutionsAtFourthOrder) {
  for (const Case& c :
       {Case{"kink", exact::kink(0.5), 0, 10}, Case{"breather", exact::breather(0.6), 0.3, 10},
        Case{"kink-kink", exact::kink_kink(0.5), -8, 8}, Case{"kink-antikink", exact::kink_antikink(0.5), -8, 8}}) {
    double last = 0;
    for (const double h : {0.2, 0.1, 0.05}) {
      const Problem p = on_grid(30, h);
      chain::ExplicitChain run(p, exact::motion_of(c.u, p.grid, c.from));
      run.advance_to(c.to - c.from);
      const double error = exact::error(run, c.u, c.from);
      RecordProperty(std::string(c.name) + std::to_string(h), std::to_string(error));
      if (last > 0) {
        EXPECT_GT(last / error, 14) << c.name << " h = " << h << ": " << last << " to " << error;
      }
      last = error;
    }
    EXPECT_LT(last, 5e-5) << c.name;
  }
}

/// A force near an end does the same work as its mirror image near the other end.
TEST(Chain, WorkAtAnEndIsThatOfItsMirrorImage) {
  const auto flows = [](double sign, bool steady, const friction::Friction& friction) {
    Problem p = on_grid(10, 0.2);
    p.boundary = {.left = End::free, .right = End::free};
    p.friction = friction;
    p.steady_forcing = steady;
    p.forcing = [=](double x, double t) {
      return 0.5 * std::exp(-(10 - sign * x) * (10 - sign * x)) * (steady ? 1 : std::cos(t));
    };
    chain::ExplicitChain run(p, {std::vector<double>(p.grid.sites, 0.0), {}});
    run.advance_to(4);
    return run.flows();
  };
  for (const bool steady : {false, true})
    for (const friction::Friction& friction : {friction::viscous(0.3), friction::power(0.3, 2)}) {
      const Flows right = flows(1, steady, friction), left = flows(-1, steady, friction);
      EXPECT_GT(right.supplied, 0.1);
      EXPECT_NEAR(left.supplied / right.supplied, 1, 1e-12);
      EXPECT_NEAR(left.dissipated / right.dissipated, 1, 1e-12);
    }
}

}  // namespace
