// Rates and steps of a pulse allocate nothing once their arrays exist.
#include "allocations.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <vector>

#include "averages/pulse/grid/layout.hpp"
#include "averages/pulse/steps/stepper.hpp"
#include "law_values.hpp"
#include "slipfront/friction/friction.hpp"

#if !SLIPFRONT_SANITIZED

namespace {

using namespace slipfront;
using pulse::Problem;

Problem problem(const friction::Friction& friction) {
  return {.stress = [](double x) { return x < 0 ? 0.855 : 0.179; },
          .forcing = {},
          .friction = friction,
          .left = -2,
          .right = 2,
          .left_end = pulse::End::fixed,
          .right_end = pulse::End::fixed,
          .cells = 100};
}

/// Takes 40 steps twice from the start. In the second round all arrays and tables of the law exist.
void expect_no_allocations(const Problem& problem, const char* what) {
  const pulse::Start start = pulse::start_of(problem);
  const pulse::InitialGrid initial(problem, start.cells, start.free);
  pulse::Stepper stepper(problem, initial);
  for (const bool warm : {false, true}) {
    pulse::Cells cells = start.cells;
    cells.state = stepper.state_grid().initial();
    if (!warm) stepper.rebuild(cells);
    for (int i = 0; i < 40; ++i) {
      const long made = allocations::count([&] { stepper.step(cells, 1e9); });
      ASSERT_EQ(cells.size(), start.cells.size()) << "other cells have other arrays";
      // The first step fills arrays of the cells themselves.
      if (warm && i > 0) {
        EXPECT_EQ(made, 0) << what << ", step " << i;
      }
    }
  }
}

TEST(PulseAllocations, RatesMakeNone) {
  const Problem p = problem(friction::viscous(0.5));
  const pulse::Start start = pulse::start_of(p);
  pulse::Semidiscrete equations(pulse::setup_of(p, start.cells, start.free));
  std::vector<double> rates(start.cells.unknowns.size());
  equations.start_from(start.cells.s);
  equations(0, start.cells.unknowns.data(), rates.data());
  EXPECT_EQ(allocations::count([&] { equations(0, start.cells.unknowns.data(), rates.data()); }), 0);
}

TEST(PulseAllocations, ExplicitStepsMakeNone) {
  expect_no_allocations(problem(friction::viscous(0.5)), "viscous");
  expect_no_allocations(problem(friction::coulomb(0.03)), "coulomb");
  Problem forced = problem(friction::viscous(0.5));
  forced.forcing = [](double x, double t) { return 0.01 * x * t; };
  forced.contact = [](double x) { return 1 + 0.01 * x * x; };
  expect_no_allocations(forced, "forced");
}

TEST(PulseAllocations, ImplicitStepsMakeNone) {
  expect_no_allocations(problem(friction::viscous(1e4)), "viscous");
  expect_no_allocations(problem(friction::viscous(1e4, friction::Closure::paper)), "viscous, closure paper");
}

TEST(PulseAllocations, StepsThatSplitFrictionOffMakeNone) {
  expect_no_allocations(problem(friction::law_of("rate-and-state", {0.0125, 0.003, 0, 1, 0.05, 0, 0})),
                        "rate-and-state");
  expect_no_allocations(problem(friction::power(0.0125, 0.7)), "power");
}

TEST(PulseAllocations, StepsByFacesMakeNone) { expect_no_allocations(problem(friction::power(50, 0.5)), "power"); }

}  // namespace

#endif
