#include <benchmark/benchmark.h>

#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <vector>

#include "averages/pulse/space/kernels.hpp"
#include "averages/pulse/space/semidiscrete.hpp"
#include "math/simd/vector_code.hpp"
#include "slipfront/theory/modulation/modulation.hpp"
#include "theory/modulation/modulation.hpp"

// Measures the cell stage of a `pulse` run and its two costliest loops. It compares them with the limit of the
// arithmetic units, which is the rate of a loop of independent fused multiply-adds with the same vector width in the
// same run. Operations are those of the AVX-512 loops that g++ 12 makes. An addition or multiplication counts as one, a
// fused pair as two, and comparisons, selections, conversions and divisions as none. Two operations in single precision
// count as one in double. Bytes are those of the arrays that are read and written, 8 per number, all in the first two
// caches.

namespace {

using namespace slipfront;

constexpr std::size_t cells = 400;

/// Ten independent sequences of one 64-byte vector each hide the latency of the units.
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

/// Largest number of operations per second.
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

/// Runs the kernel and reports which fraction of the limit it reaches.
template <class Kernel>
void measure(benchmark::State& state, double operations, int divisions, int numbers, Kernel kernel) {
  const double limit = fma_limit();
  const auto start = std::chrono::steady_clock::now();
  for (auto _ : state) {
    kernel();
    benchmark::ClobberMemory();
  }
  const std::chrono::duration<double> time = std::chrono::steady_clock::now() - start;
  const double done = static_cast<double>(state.iterations()) * cells, rate = done * operations / time.count();
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(cells));
  char label[200];
  std::snprintf(
      label, sizeof label,
      "%.1f ns a cell: %.0f operations, %d divisions, %d bytes; %.0f of %.0f GFlop/s, %.0f %% of the FMA limit",
      time.count() / done * 1e9, operations, divisions, 8 * numbers, rate / 1e9, limit / 1e9, 100 * rate / limit);
  state.SetLabel(label);
}

/// A smooth pulse.
struct Pulse {
  std::vector<double> phi, psi, spacing, momentum;
  Pulse() {
    for (std::size_t i = 0; i < cells; ++i) {
      const double x = (static_cast<double>(i) - 200) / 60;
      phi.push_back(0.15 / (std::cosh(x) * std::cosh(x)));
      psi.push_back(0.002 + 0.05 * (1 - std::tanh(x)));
      const auto c = modulation::lagrangian_state({phi.back(), psi.back()});
      spacing.push_back(c.spacing);
      momentum.push_back(c.momentum);
    }
  }
};

void kernel_solve_states(benchmark::State& state) {
  const Pulse p;
  std::vector<double> guess(cells), s(cells), phi(cells), psi(cells), sound(cells), EK(cells), U(cells), solved(cells);
  for (std::size_t i = 0; i < cells; ++i) guess[i] = std::tanh(p.psi[i]) * 1.002;
  measure(state, 342, 4, 15, [&] {
    s = guess;
    modulation::solve_states({cells, p.spacing.data(), p.momentum.data(), s.data(), phi.data(), psi.data(),
                              sound.data(), EK.data(), U.data(), solved.data()});
  });
}
BENCHMARK(kernel_solve_states);

void kernel_faces(benchmark::State& state) {
  const Pulse p;
  std::vector<double> plus(cells + 6), minus(cells + 6), phi(cells), psi(cells), U(cells), pressure(cells);
  for (std::size_t i = 0; i < cells + 6; ++i) {
    const std::size_t cell = i < 3 ? 0 : i - 3 < cells ? i - 3 : cells - 1;
    plus[i] = p.phi[cell] + p.psi[cell];
    minus[i] = p.phi[cell] - p.psi[cell];
  }
  measure(state, 281, 2, 8, [&] {
    pulse::weno_faces(cells, plus.data() + 3, minus.data() + 3, 1, phi.data(), psi.data());
    pulse::face_fluxes(cells, phi.data(), psi.data(), 0, U.data(), pressure.data());
  });
}
BENCHMARK(kernel_faces);

void kernel_stage(benchmark::State& state) {
  const Pulse p;
  pulse::Setup setup;
  setup.charge.assign(cells, 0.01);
  setup.friction = friction::viscous(0.5, friction::Closure::consistent);
  pulse::Semidiscrete equations(std::move(setup));
  std::vector<double> y(pulse::Values::size(cells)), dy(y.size()), s(cells);
  for (std::size_t i = 0; i < cells; ++i) {
    y[i] = 0.01 * p.spacing[i];
    y[cells + i] = 0.01 * p.momentum[i];
    s[i] = std::tanh(p.psi[i]) * 1.002;
  }
  measure(state, 707, 10, 57, [&] {
    equations.start_from(s);
    equations(0, y.data(), dy.data());
  });
}
BENCHMARK(kernel_stage);

}  // namespace
