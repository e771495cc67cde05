// Site updates per second of every dislocation line of a plane, compared with the kernel of a chain and with the limit
// of the arithmetic units in the same run. Run it with --benchmark_filter=plane.

#include <benchmark/benchmark.h>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <vector>

#include "lattice/chain/explicit/explicit_chain.hpp"
#include "lattice/plane/direct/motion.hpp"
#include "lattice/plane/direct/sites.hpp"
#include "multiply_adds.hpp"

namespace {

using namespace slipfront;

/// Multiplications and additions per site and step, where a fused pair counts once: 9 for each of two Laplacians, 24
/// for sine and cosine, 17 for v, its rate, u_t and u.
constexpr double operations_a_site = 59;

/// Calls `work`, which does so many updates, for a fifth of a second. Returns updates per second.
template <class Work>
double rate_of(double updates, const Work& work) {
  using Clock = std::chrono::steady_clock;
  work();
  const auto start = Clock::now();
  long calls = 0;
  std::chrono::duration<double> time{};
  for (; time.count() < 0.2; ++calls, time = Clock::now() - start) work();
  return updates * static_cast<double>(calls) / time.count();
}

double multiply_adds_per_second() {
  static const double rate = [] {
    std::vector<double> v(1024, 0.5);
    return rate_of(32 * 1024.0, [&] {
      multiply_adds(v.data(), v.size(), 0.5, 0.25);
      benchmark::DoNotOptimize(v.data());
      benchmark::ClobberMemory();
    });
  }();
  return rate;
}

/// The chain of bench/chain_bench.cpp, 100 000 sites on one core.
double chain_sites_per_second() {
  static const double rate = [] {
    constexpr std::size_t sites = 100000;
    chain::Motion m;
    m.u.resize(sites);
    for (std::size_t j = 0; j < sites; ++j)
      m.u[j] = -0.4 * static_cast<double>(j) + 0.2 * std::sin(static_cast<double>(j % 1000));
    chain::ExplicitChain run({.grid = {0, 0.5, sites},
                              .model = chain::Model::sine_gordon,
                              .boundary = {},
                              .friction = friction::viscous(1e-4),
                              .forcing = {},
                              .contact = {}},
                             m);
    return rate_of(960.0 * sites, [&] { run.advance(960); });
  }();
  return rate;
}

/// A bowl of lines on a square. The arguments are the sites along one side, the threads, and the kind of problem.
void plane_sites(benchmark::State& state) {
  const char* const kinds[] = {"no friction", "viscous friction", "contact and force", "Coulomb friction"};
  const double side = 0.4 * static_cast<double>(state.range(0));
  plane::Problem p;
  p.left = p.bottom = -side / 2;
  p.right = p.top = side / 2;
  if (state.range(2) == 1) p.friction = friction::viscous(1e-3);
  if (state.range(2) == 2) {
    p.contact = [](double x, double) { return 1 - 0.1 * std::cos(x); };
    p.forcing = [](double, double, double) { return 1e-3; };
    p.steady_forcing = true;
  }
  if (state.range(2) == 3) p.friction = friction::coulomb(1e-3);
  const plane::Sites sites = plane::make_sites(p, 1, 0.4);
  plane::Stepper stepper(p, sites, static_cast<int>(state.range(1)));
  std::vector<double> u(sites.size(), 0.0);
  for (std::size_t j = 0; j < sites.ny; ++j)
    for (std::size_t i = 0; i < sites.nx; ++i) u[sites.at(i, j)] = 0.3 * (side - std::hypot(sites.x(i), sites.y(j)));
  plane::Motion motion = stepper.start(std::move(u));
  double time = 0;
  const long before = motion.steps;
  for (auto _ : state) {
    time += 4;
    stepper.advance(motion, time, {});
  }
  const double updates = static_cast<double>((motion.steps - before) * static_cast<long>(sites.nx * sites.ny));
  state.SetItemsProcessed(static_cast<long>(updates));
  char label[160];
  std::snprintf(label, sizeof label, "%s; the limit of %.0f operations is %.2f G/s a core, a chain has %.2f G/s a core",
                kinds[state.range(2)], operations_a_site, multiply_adds_per_second() / operations_a_site / 1e9,
                chain_sites_per_second() / 1e9);
  state.SetLabel(label);
}
BENCHMARK(plane_sites)
    ->Args({200, 1, 0})
    ->Args({200, 1, 1})
    ->Args({200, 1, 2})
    ->Args({200, 1, 3})
    ->Args({1000, 1, 0})
    ->Args({1000, 1, 1})
    ->Args({1000, 1, 2})
    ->Args({1000, 1, 3})
    ->Args({1000, 2, 0})
    ->Args({4000, 2, 0})
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();

}  // namespace
