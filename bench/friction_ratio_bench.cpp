// One evaluation of the table of friction ratios, with both derivatives.

#include <benchmark/benchmark.h>

#include "slipfront/friction_ratio/table.hpp"

namespace {

void friction_ratio_evaluate(benchmark::State& state) {
  using namespace slipfront;
  double stress = 0.2, damping = 0.1;
  for (auto _ : state) {
    benchmark::DoNotOptimize(
        friction_ratio::evaluate(friction_ratio::Measure::origin, friction::Closure::consistent, stress, damping));
    stress = stress > 2.9 ? 0.2 : stress * 1.01;
    damping = damping > 1e7 ? 0.1 : damping * 1.1;
  }
}
BENCHMARK(friction_ratio_evaluate);

}  // namespace
