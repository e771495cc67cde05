#include <benchmark/benchmark.h>

#include <cmath>
#include <vector>

#include "slipfront/math/elliptic.hpp"
#include "slipfront/theory/rupture/relations.hpp"
#include "slipfront/theory/rupture/riemann.hpp"
#include "slipfront/theory/rupture/trains.hpp"
#include "slipfront/theory/train.hpp"

namespace {

constexpr std::size_t count = 1024;

/// Inputs spread evenly in the logarithm, so that no branch is favoured.
std::vector<double> spread(double low, double high) {
  std::vector<double> values(count);
  for (std::size_t i = 0; i < count; ++i) values[i] = low * std::pow(high / low, static_cast<double>(i) / (count - 1));
  return values;
}

template <class Function>
void run(benchmark::State& state, double low, double high, Function&& function) {
  const std::vector<double> inputs = spread(low, high);
  for (auto _ : state)
    for (const double x : inputs) benchmark::DoNotOptimize(function(x));
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(count));
}

/// The limit that the solves below are built on: one K, E pair with its logarithm or its mean.
void at_psi(benchmark::State& state) {
  run(state, 1e-12, 5, [](double psi) { return slipfront::elliptic::at_psi(psi); });
}
BENCHMARK(at_psi);

void jacobi(benchmark::State& state) {
  const auto at = slipfront::elliptic::at_psi(0.1);
  run(state, 1e-3, 10, [&](double z) { return slipfront::elliptic::jacobi(z, at); });
}
BENCHMARK(jacobi);

void train_averages(benchmark::State& state) {
  run(state, 1e-12, 5, [](double psi) { return slipfront::train::averages({0.3, psi}); });
}
BENCHMARK(train_averages);

/// Two trains, with a gap from 1e-9 to 5 between bands of width 0.3.
void two_trains_speeds(benchmark::State& state) {
  run(state, 1e-9, 5, [](double gap) { return slipfront::rupture::edge_speeds({0.2, {0.3, gap, 0.3}}); });
}
BENCHMARK(two_trains_speeds);

void two_trains_averages(benchmark::State& state) {
  run(state, 1e-9, 5, [](double gap) { return slipfront::rupture::averages({0.2, {0.3, gap, 0.3}}); });
}
BENCHMARK(two_trains_averages);

/// Nine outputs each.
void relations_from_stress(benchmark::State& state) { run(state, 0.01, 10, slipfront::rupture::from_stress); }
BENCHMARK(relations_from_stress);

void relations_from_rupture_velocity(benchmark::State& state) {
  run(state, 1e-100, 0.999, slipfront::rupture::from_rupture_velocity);
}
BENCHMARK(relations_from_rupture_velocity);

void relations_from_slip_velocity(benchmark::State& state) {
  run(state, 1e-100, 10, slipfront::rupture::from_slip_velocity);
}
BENCHMARK(relations_from_slip_velocity);

void riemann_with_shock(benchmark::State& state) {
  run(state, 1e-6, 0.09, [](double psi) { return slipfront::rupture::solve_riemann({0, 0.1}, {0, psi}); });
}
BENCHMARK(riemann_with_shock);

}  // namespace
