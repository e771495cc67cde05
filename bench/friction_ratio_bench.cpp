// One evaluation of the tables of friction ratios, of observed fronts and of stress drops, with both derivatives.

#include <benchmark/benchmark.h>

#include "slipfront/friction/ratio/table.hpp"

namespace {

using namespace slipfront;
using friction::Closure;

/// Calls `function(stress, damping)` at points all over the table.
template <class Function>
void sweep(benchmark::State& state, const Function& function) {
  double stress = 0.2, damping = 0.1;
  for (auto _ : state) {
    benchmark::DoNotOptimize(function(stress, damping));
    stress = stress > 2.9 ? 0.2 : stress * 1.01;
    damping = damping > 1e7 ? 0.1 : damping * 1.1;
  }
}

void friction_ratio_evaluate(benchmark::State& state) {
  sweep(state, [](double stress, double damping) {
    return friction_ratio::evaluate(friction_ratio::SlipVelocityKind::origin, Closure::consistent, stress, damping);
  });
}
BENCHMARK(friction_ratio_evaluate);

void friction_ratio_value(benchmark::State& state) {
  sweep(state, [](double stress, double damping) {
    return friction_ratio::evaluate_value(friction_ratio::SlipVelocityKind::origin, Closure::consistent, stress,
                                          damping);
  });
}
BENCHMARK(friction_ratio_value);

void friction_ratio_front(benchmark::State& state) {
  const friction_ratio::FrontCurve curve(Closure::consistent, 1e-3);
  sweep(state, curve);
}
BENCHMARK(friction_ratio_front);

void friction_ratio_front_at_threshold(benchmark::State& state) {
  double threshold = 1e-4;
  sweep(state, [&](double stress, double damping) {
    threshold = threshold > 0.25 ? 1e-4 : threshold * 1.1;
    return friction_ratio::front_ratio(Closure::consistent, stress, damping, threshold);
  });
}
BENCHMARK(friction_ratio_front_at_threshold);

void friction_ratio_stress_drop(benchmark::State& state) {
  sweep(state, [](double stress, double damping) {
    return friction_ratio::stress_drop_share(friction_ratio::Drop::origin, Closure::consistent, stress, damping);
  });
}
BENCHMARK(friction_ratio_stress_drop);

}  // namespace
