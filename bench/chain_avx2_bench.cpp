// The kernel of the chain as an AVX2 machine runs it, on any machine that has AVX2: this file is compiled for
// x86-64-v3.

#define SLIPFRONT_CLONES
#define slipfront slipfront_avx2  // its own copy of the kernel
#include "lattice/chain/explicit/levels/kernel.cpp"
#include "lattice/chain/model/periodic_force.cpp"
#undef slipfront

#include <benchmark/benchmark.h>

#include <cmath>
#include <utility>

namespace {

using namespace slipfront_avx2::chain;

void chain_sites_avx2(benchmark::State& state) {
#if defined(__x86_64__)
  if (!__builtin_cpu_supports("avx2") || !__builtin_cpu_supports("fma")) {
    state.SkipWithError("no AVX2 here");
    return;
  }
#endif
  constexpr std::size_t sites = 1400, room = sites + 2 * lanes;
  alignas(64) static double a[room], b[room], y[room];
  for (std::size_t j = 0; j < room; ++j) a[j] = b[j] = 0.03 * std::sin(static_cast<double>(j));
  LevelRule rule;  // h = 0.5
  rule.f = substrate_force(1.0 / 48);
  rule.spread = 1 - 1.0 / 48;
  rule.before = 1;
  rule.coupled = 1.0 / 24;
  rule.keep = 2 - 2 * rule.spread;
  rule.force = 0.2;
  double *now = a, *next = b;
  for (auto _ : state) {
    local_part(rule, now, next, next, y, lanes, lanes + sites);
    add_neighbours(rule.spread, y, next, lanes, lanes + sites);
    std::swap(now, next);
    benchmark::DoNotOptimize(next);
    benchmark::ClobberMemory();
  }
  state.SetItemsProcessed(state.iterations() * static_cast<long>(sites));
}
BENCHMARK(chain_sites_avx2);

}  // namespace
