#include <benchmark/benchmark.h>

#include <chrono>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "pulse/kernels.hpp"
#include "pulse/semidiscrete.hpp"
#include "pulse/vector_code.hpp"
#include "slipfront/modulation/per_dislocation.hpp"

// The cell stage of a pulse run, alone and by its two costliest loops, beside the limit of the arithmetic units: what a
// loop of nothing but independent fused multiply-adds reaches, same vector width, same run. Operations are counted in
// the kernels' sources (an addition or multiplication is one; a comparison, choice or conversion none; two in single
// precision count as one in double, as the units do), bytes as arrays read and written.

namespace {

using namespace slipfront;

constexpr std::size_t cells = 400;

/// Ten chains of one vector each hide the latency of the units.
SLIPFRONT_CLONES void multiply_add(double* x, std::size_t repeats) {
  constexpr std::size_t width = 80;
  double sum[width];
  for (std::size_t j = 0; j < width; ++j) sum[j] = x[j];
  for (std::size_t r = 0; r < repeats; ++r) {
    SLIPFRONT_INDEPENDENT
    for (std::size_t j = 0; j < width; ++j) sum[j] = sum[j] * 0.999 + 1e-3;
  }
  for (std::size_t j = 0; j < width; ++j) x[j] = sum[j];
}

/// Operations a second.
double fma_limit() {
  static const double limit = [] {
    double x[80] = {}, best = 0;
    constexpr std::size_t repeats = 100000;
    for (int attempt = 0; attempt < 20; ++attempt) {
      const auto start = std::chrono::steady_clock::now();
      multiply_add(x, repeats);
      benchmark::DoNotOptimize(x);
      const std::chrono::duration<double> time = std::chrono::steady_clock::now() - start;
      best = std::fmax(best, 2.0 * 80 * repeats / time.count());
    }
    return best;
  }();
  return limit;
}

void report(benchmark::State& state, double operations, double divisions, double bytes) {
  const auto done = static_cast<double>(state.iterations()) * cells;
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(cells));
  using benchmark::Counter;
  state.counters["ns_a_cell"] = Counter(done / 1e9, Counter::kIsRate | Counter::kInvert);
  state.counters["of_FMA_limit"] = Counter(done * operations / fma_limit(), Counter::kIsRate);
  state.counters["GFlop_limit"] = fma_limit() / 1e9;
  state.SetLabel(std::to_string(static_cast<int>(operations)) + " operations, " +
                 std::to_string(static_cast<int>(divisions)) + " divisions, " +
                 std::to_string(static_cast<int>(bytes)) + " bytes a cell");
}

/// A smooth pulse.
struct Pulse {
  std::vector<double> phi, psi, spacing, momentum;
  Pulse() {
    for (std::size_t i = 0; i < cells; ++i) {
      const double x = (static_cast<double>(i) - 200) / 60;
      phi.push_back(0.15 / (std::cosh(x) * std::cosh(x)));
      psi.push_back(0.002 + 0.05 * (1 - std::tanh(x)));
      const auto c = modulation::carried({phi.back(), psi.back()});
      spacing.push_back(c.spacing);
      momentum.push_back(c.momentum);
    }
  }
};

void kernel_resolve_all(benchmark::State& state) {
  const Pulse p;
  std::vector<double> guess(cells), s(cells), phi(cells), psi(cells), sound(cells), EK(cells), U(cells), good(cells);
  for (std::size_t i = 0; i < cells; ++i) guess[i] = std::tanh(p.psi[i]) * 1.01;
  for (auto _ : state) {
    s = guess;
    pulse::resolve_all({cells, p.spacing.data(), p.momentum.data(), s.data(), phi.data(), psi.data(), sound.data(),
                        EK.data(), U.data(), good.data()});
    benchmark::ClobberMemory();
  }
  report(state, 0, 4, 18 * 8);
}
BENCHMARK(kernel_resolve_all);

void kernel_faces(benchmark::State& state) {
  const Pulse p;
  std::vector<double> plus(cells + 6), minus(cells + 6), phi(cells), psi(cells), U(cells), pressure(cells);
  for (std::size_t i = 0; i < cells + 6; ++i) {
    const std::size_t cell = i < 3 ? 0 : i - 3 < cells ? i - 3 : cells - 1;
    plus[i] = p.phi[cell] + p.psi[cell];
    minus[i] = p.phi[cell] - p.psi[cell];
  }
  for (auto _ : state) {
    pulse::weno_faces(cells, plus.data() + 3, minus.data() + 3, 1, phi.data(), psi.data());
    pulse::face_fluxes(cells, phi.data(), psi.data(), U.data(), pressure.data());
    benchmark::ClobberMemory();
  }
  report(state, 0, 2, 8 * 8);
}
BENCHMARK(kernel_faces);

void kernel_stage(benchmark::State& state) {
  const Pulse p;
  pulse::Semidiscrete equations({std::vector<double>(cells, 0.01),
                                 false,
                                 false,
                                 {modulation::FrictionLaw::viscous, 0.5, 1, modulation::Closure::consistent},
                                 {}});
  std::vector<double> y(2 * cells + pulse::Semidiscrete::extra), dy(y.size()), s(cells);
  for (std::size_t i = 0; i < cells; ++i) {
    y[2 * i] = 0.01 * p.spacing[i];
    y[2 * i + 1] = 0.01 * p.momentum[i];
    s[i] = std::tanh(p.psi[i]) * 1.01;
  }
  for (auto _ : state) {
    equations.start_from(s);
    equations(0, y.data(), dy.data());
    benchmark::ClobberMemory();
  }
  report(state, 0, 8, 0);
}
BENCHMARK(kernel_stage);

}  // namespace
