// Site updates a second of a chain that MPI ranks share, for comparison with threads:
//     chain_ranks THREADS [SITES]    mpirun --bind-to none -n 2 chain_ranks 1

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>

#include "lattice/chain/explicit/explicit_chain.hpp"
#include "lattice/chain/model/initial_train.hpp"
#include "slipfront/lattice/chain/chain.hpp"
#include "system/ranks.hpp"

int main(int argc, char** argv) {
  using namespace slipfront::chain;
  const slipfront::Ranks ranks = slipfront::Ranks::of_mpirun();
  const int threads = argc > 1 ? std::atoi(argv[1]) : 1;
  const std::size_t sites = argc > 2 ? std::strtoul(argv[2], nullptr, 10) : 1000000;
  const Problem p{.grid = {0, 0.5, sites},
                  .model = Model::sine_gordon,
                  .boundary = {},
                  .friction = slipfront::friction::viscous(1e-4),
                  .forcing = {},
                  .contact = {}};
  try {
    ExplicitChain chain(p, StaticTrain([](double) { return 0.8; }, p.grid), {.threads = threads, .ranks = &ranks});
    const long levels = 32 * std::max(1L, 10000000 / static_cast<long>(sites));
    double best = 0;
    for (int i = 0; i < 7; ++i) {
      const auto start = std::chrono::steady_clock::now();
      chain.advance(levels);
      const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
      best = std::max(best, static_cast<double>(levels) * static_cast<double>(sites) / took.count());
    }
    if (ranks.rank() == 0)
      std::printf("%d ranks, %d threads each, %zu sites: %.3g G site updates / s\n", ranks.size(), threads, sites,
                  best / 1e9);
  } catch (const std::exception& error) {
    return ranks.failed(1, [&] { std::fprintf(stderr, "%s\n", error.what()); });
  }
}
