#include <gtest/gtest.h>

#include "chain/explicit/explicit_chain.hpp"
#include "exact_chains.hpp"

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

}  // namespace
