#include <benchmark/benchmark.h>

#include <cmath>
#include <numbers>

#include "slipfront/modulation/per_dislocation.hpp"
#include "slipfront/pulse/solver.hpp"
#include "slipfront/train/train.hpp"

namespace {

using namespace slipfront;

pulse::Problem tanh_step(int cells, friction::Closure closure) {
  return {.stress = [](double x) { return 0.179 + 0.676 * (1 - std::tanh(x)) / 2; },
          .forcing = {},
          .friction = friction::viscous(0.5, closure),
          .left = -7.5,
          .right = 5.5,
          .corner = HUGE_VAL,
          .cells = cells};
}

/// The row "tanh width 1, C = 0.5" to t = 2 pi; the label tells what W(0) came out.
void pulse_tanh(benchmark::State& state) {
  const pulse::Problem problem = tanh_step(static_cast<int>(state.range(0)), friction::Closure::consistent);
  double W = 0;
  long steps = 0;
  for (auto _ : state) {
    pulse::Solver solver(problem);
    solver.advance_to(2 * std::numbers::pi);
    W = train::averages(state_at(solver.view(), 0)).W;
    steps = solver.cells().steps;
  }
  state.SetItemsProcessed(state.iterations() * state.range(0) * steps * 5);
  state.SetLabel("W(0) = " + std::to_string(W) + ", cell stages a second");
}
BENCHMARK(pulse_tanh)->Arg(50)->Arg(75)->Arg(100)->Arg(200)->Arg(400)->Unit(benchmark::kMillisecond);

/// Conserved to primitive, the costliest part of a cell: started from 1 % off, as from one stage to the next.
void solve_state(benchmark::State& state) {
  const auto c = modulation::lagrangian_state({0.1, 0.05});
  for (auto _ : state) benchmark::DoNotOptimize(modulation::solve_state(c, 0.0505));
  state.SetItemsProcessed(state.iterations());
}
BENCHMARK(solve_state);

/// Friction so strong that the pulse diffuses; steps are implicit.
void pulse_overdamped(benchmark::State& state) {
  const double gamma = static_cast<double>(state.range(0));
  pulse::Problem problem{.stress = [](double x) { return x < 0 ? 0.855 : 0.0; },
                         .forcing = {},
                         .friction = friction::viscous(gamma / (2 * std::numbers::pi)),
                         .left = -20 / std::sqrt(gamma),
                         .right = 20 / std::sqrt(gamma),
                         .cells = 100};
  long steps = 0;
  for (auto _ : state) {
    pulse::Solver solver(problem);
    solver.advance_to(2 * std::numbers::pi);
    steps = solver.cells().steps;
  }
  state.SetLabel(std::to_string(steps) + " steps");
}
BENCHMARK(pulse_overdamped)->Arg(1000)->Arg(1000000)->Arg(100000000)->Unit(benchmark::kMillisecond);

}  // namespace
