// Steps of warm chains allocate nothing.
#include "allocations.hpp"

#include <gtest/gtest.h>

#include <string>

#include "lattice/chain/explicit/explicit_chain.hpp"
#include "lattice/chain/implicit/implicit_chain.hpp"
#include "loaded_chains.hpp"
#include "rough_chains.hpp"

#if !SLIPFRONT_SANITIZED

namespace {

using namespace slipfront;
using namespace slipfront::chain;

TEST(ChainAllocations, ExplicitStepsMakeNone) {
  for (const std::size_t sites : {130u, 12000u})  // the longest of them take 32 levels at a time
    for (int kind = 0; kind < cases::kinds; ++kind) {
      const Problem p = cases::problem(sites, kind);
      ExplicitChain chain(p, cases::bumpy(p));
      chain.advance(64);
      EXPECT_EQ(allocations::count([&] { chain.advance(64); }), 0) << sites << " sites, kind " << kind;
    }
}

TEST(ChainAllocations, ExplicitStepsUnderFrictionWithStateMakeNone) {
  Problem p = cases::problem(200, 0);
  p.friction = loaded::rate_and_state(0.05, 0.01, 0.015, 6, 0.05, 0);
  ExplicitChain chain(p, cases::bumpy(p));
  chain.advance(64);
  EXPECT_EQ(allocations::count([&] { chain.advance(64); }), 0);
}

/// Between two events, with outputs inside a step.
TEST(ChainAllocations, ImplicitStepsMakeNone) {
  const Problem block = loaded::block_of_laboratory();
  Problem ring;
  ring.grid = {0, 0.5, 50};
  ring.implicit = true;
  ring.boundary = {.periodic = true, .charge = 8};
  ring.contact = [](double x) { return 1 + 0.05 * std::cos(loaded::turn / 25 * x); };
  ring.friction = friction::viscous(0.5);
  ring.loading = {.stiffness = 4e-5, .velocity = 1e-4, .event_velocity = 1e3};
  Motion train = loaded::at_rest(ring);
  for (std::size_t j = 0; j < ring.grid.sites; ++j) train.u[j] = -loaded::turn * 8 * static_cast<double>(j) / 50;
  for (const auto& [problem, start] : {std::pair{block, loaded::at_rest(block)}, {ring, train}}) {
    ImplicitChain chain(problem, start);
    for (double t = 1; t < 10; ++t) chain.advance_to(t);
    const long before = chain.steps();
    EXPECT_EQ(allocations::count([&] {
                for (double t = 10; t < 1e5; t *= 1.02) chain.advance_to(t);
              }),
              0);
    EXPECT_GT(chain.steps(), before + 5);
    EXPECT_GT(allocations::count([&] { chain.window(0, 8); }), 0);  // they are counted
  }
}

}  // namespace

#endif
