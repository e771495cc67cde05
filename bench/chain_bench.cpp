// Site updates per second of a chain, compared with two limits of the machine: only the polynomial of the sine, and
// multiply-adds in registers. Run it with --benchmark_filter=chain.

#include <benchmark/benchmark.h>

#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "lattice/chain/explicit/explicit_chain.hpp"
#include "lattice/chain/explicit/levels/kernel.hpp"
#include "math/simd/vector_code.hpp"
#include "multiply_adds.hpp"
#include "slipfront/lattice/chain/chain.hpp"
#include "slipfront/lattice/chain/run.hpp"
#include "slipfront/scenario/problem.hpp"

namespace {

using namespace slipfront;
using namespace slipfront::chain;

/// Multiplications and additions per site, where a fused pair counts once: 3 to reduce the argument, 1 to square it, 8
/// for the polynomial, 4 for y and the local part, 2 for the neighbours.
constexpr double operations_a_site = 18;

SLIPFRONT_CLONES void sines(const PeriodicForce& force, const double* z, double* S, std::size_t n) {
  const PeriodicForce f = force;
  SLIPFRONT_INDEPENDENT
  for (std::size_t j = 0; j < n; ++j) S[j] = f(z[j]);
}

void chain_limit_sine(benchmark::State& state) {
  const PeriodicForce f = substrate_force(1.0 / 48);
  std::vector<double> z(1024), S(1024);
  for (std::size_t j = 0; j < z.size(); ++j) z[j] = 1e4 * std::sin(static_cast<double>(j));
  for (auto _ : state) {
    sines(f, z.data(), S.data(), z.size());
    benchmark::DoNotOptimize(S.data());
    benchmark::ClobberMemory();
  }
  state.SetItemsProcessed(state.iterations() * 1024);
}
BENCHMARK(chain_limit_sine);

void chain_limit_multiply_adds(benchmark::State& state) {
  std::vector<double> v(1024, 0.5);
  for (auto _ : state) {
    multiply_adds(v.data(), v.size(), 0.5, 0.25);
    benchmark::DoNotOptimize(v.data());
    benchmark::ClobberMemory();
  }
  const double all = static_cast<double>(state.iterations()) * 1024 * 32;
  state.counters["sites_at_most"] = benchmark::Counter(all / operations_a_site, benchmark::Counter::kIsRate);
  state.SetItemsProcessed(state.iterations() * 1024 * 32);
}
BENCHMARK(chain_limit_multiply_adds);

/// The loops of a site with a contact profile, in the innermost cache: 256 sites and their coefficients.
void chain_limit_contact(benchmark::State& state) {
  constexpr std::size_t sites = 256, room = sites + 2 * lanes;
  const ContactForce contact = contact_force(1.0 / 48, 1.7);
  std::vector<double> a2(room), one(room), other(room), y(room), coefficients(PeriodicForce::terms * room);
  for (std::size_t j = 0; j < room; ++j) {
    a2[j] = 1 + 0.2 * std::sin(static_cast<double>(j));
    one[j] = other[j] = 0.03 * std::sin(static_cast<double>(j));
  }
  contact_coefficients(contact, a2.data(), coefficients.data(), 0, room);
  const LevelRule rule{.f = {}, .coupled = 1.0 / 24, .keep = 1.0 / 24, .force = 0.2, .before = 1, .spread = 47.0 / 48};
  double *now = one.data(), *next = other.data();
  for (auto _ : state) {
    local_part_with_coefficients(rule, coefficients.data(), now, next, next, y.data(), lanes, lanes + sites);
    add_neighbours(rule.spread, y.data(), next, lanes, lanes + sites);
    std::swap(now, next);
    benchmark::DoNotOptimize(next);
    benchmark::ClobberMemory();
  }
  state.SetItemsProcessed(state.iterations() * static_cast<long>(sites));
}
BENCHMARK(chain_limit_contact);

Problem damped_train(std::size_t sites) {
  return {.grid = {0, 0.5, sites},
          .model = Model::sine_gordon,
          .boundary = {},
          .friction = friction::viscous(1e-4),
          .forcing = {},
          .contact = {}};
}

Motion rough_train(std::size_t sites) {
  Motion m;
  m.u.resize(sites);
  for (std::size_t j = 0; j < sites; ++j)
    m.u[j] = -0.4 * static_cast<double>(j) + 0.2 * std::sin(static_cast<double>(j % 1000));
  return m;
}

/// The arguments are the numbers of sites and threads. 1e8 sites do not fit into the caches.
void chain_sites(benchmark::State& state) {
  const auto sites = static_cast<std::size_t>(state.range(0));
  chain::ExplicitChain run(damped_train(sites), rough_train(sites), {.threads = static_cast<int>(state.range(1))});
  const long levels = sites < 10000000 ? std::max<long>(32, 32 * (3000000 / static_cast<long>(sites))) : 64;
  for (auto _ : state) run.advance(levels);
  state.SetItemsProcessed(state.iterations() * levels * static_cast<long>(sites));
}
BENCHMARK(chain_sites)
    ->Args({1400, 1})
    ->Args({10000, 1})
    ->Args({100000, 1})
    ->Args({1000000, 1})
    ->Args({1000000, 2})
    ->Args({100000000, 1})
    ->Args({100000000, 2})
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();

/// Rate-and-state friction that is weak enough for the train of rough_train to keep moving.
friction::Friction weak_rate_and_state() {
  for (const friction::Definition* law : friction::laws())
    if (law->name == "rate-and-state") return {*law, {1e-4, 2e-5, 3e-5, 50, 0.05, 0, 0}};
  return {};
}

/// Chains with a contact profile, with a forcing (that changes with time, or not), with dry and with viscous friction,
/// with friction that has a state, and with a contact profile and a forcing.
void chain_general(benchmark::State& state) {
  const char* const kinds[] = {"contact",
                               "forcing",
                               "steady forcing",
                               "Coulomb friction",
                               "viscous friction",
                               "rate-and-state friction",
                               "contact and steady forcing"};
  const auto kind = static_cast<std::size_t>(state.range(0));
  constexpr std::size_t sites = 100000;
  Problem p = damped_train(sites);
  if (kind == 0 || kind == 6) p.contact = [](double x) { return 1 + 0.1 * std::sin(x); };
  if (kind == 1 || kind == 2 || kind == 6) p.forcing = [](double x, double t) { return 0.01 * std::sin(x - t); };
  p.steady_forcing = kind == 2 || kind == 6;
  if (kind == 3) p.friction = friction::coulomb(0.01);
  if (kind == 5) p.friction = weak_rate_and_state();
  chain::ExplicitChain run(p, rough_train(sites));
  for (auto _ : state) run.advance(32);
  state.SetItemsProcessed(state.iterations() * 32 * static_cast<long>(sites));
  state.SetLabel(kinds[kind]);
}
BENCHMARK(chain_general)->DenseRange(0, 6)->Unit(benchmark::kMillisecond);

/// The step of stress of docs/friction.md to t = 2 pi at scale 300, with rate-and-state friction. Many sites are at
/// rest.
void chain_rate_and_state(benchmark::State& state) {
  const scenario::Scenario scenario = scenario::read_scenario(
      "[initial]\nprofile = 'step'\nstress_left = 0.855\nstress_right = 0\n", "step",
      {"chain.scale=300", "friction.law=rate-and-state", "friction.strength=0.05", "friction.direct_effect=0.01",
       "friction.evolution_effect=0.015", "friction.reference_velocity=0.05", "friction.characteristic_slip=0.05"},
      {});
  const chain::ScaledProblem problem = scenario::chain_problem(scenario);
  output::Schedule schedule;
  schedule.times = {0, scenario.end};
  schedule.x_edges = {problem.left, problem.right};
  long updates = 0;
  double slip = 0;
  for (auto _ : state) {
    chain::Run run(problem, schedule, {});
    run.go();
    updates += run.chain().steps() * static_cast<long>(run.chain().problem().grid.sites);
    slip = run.snapshots().back().slip_at_origin;
  }
  state.SetItemsProcessed(updates);
  state.SetLabel("slip(0) = " + std::to_string(slip));
}
BENCHMARK(chain_rate_and_state)->Unit(benchmark::kMillisecond);

}  // namespace
