#include "lattice/chain/observe/totals.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "lattice/chain/observe/averages.hpp"
#include "math/constants.hpp"

namespace slipfront::chain {
namespace {

/// The sums among the totals, as so many numbers in a row.
constexpr std::size_t sums = 5;
std::array<double*, sums> summed(Totals& t, double& dislocations) {
  return {&t.kinetic, &t.elastic, &t.substrate, &t.momentum, &dislocations};
}

/// Adds sites [begin, end), seen in a window that has two more on either side where there are.
void add(const Sites& chain, const Window& w, std::size_t begin, std::size_t end, Totals& t, double& dislocations) {
  const Problem& p = chain.problem();
  const double h = p.grid.spacing;
  const std::size_t n = p.grid.sites, low = w.begin;
  const auto u = [&](std::size_t j) { return w.u[j - low]; };
  double next_level = std::floor(level_of(u(begin)));
  for (std::size_t j = begin; j < end; ++j) {
    const double weight = (j == 0 || j + 1 == n) && !p.boundary.periodic ? h / 2 : h;
    const double velocity = w.velocity[j - low], cosine = std::cos(u(j));
    t.kinetic += weight * velocity * velocity / 2;
    t.substrate += weight * w.contact_squared[j - low] * (1 - cosine);
    t.momentum += weight * velocity * w.stress[j - low];
    t.elastic += h * elastic_energy(u, j, n, h, p.model);
    if (j + 1 >= n) continue;
    const double level = std::exchange(next_level, std::floor(level_of(u(j + 1)))),
                 passed = std::fabs(next_level - level);
    t.steepest = std::fmax(t.steepest, std::fabs(u(j + 1) - u(j)));
    if (!(passed > 0)) continue;
    dislocations += passed;
    t.last_site = j;
    if (!t.first_site) t.first_site = j;
  }
}

/// Adds the interval of a ring from its last site, where u is `last`, to its first.
void close_ring(const Problem& p, double first, double last, Totals& t, double& dislocations) {
  const double next = first - turn * static_cast<double>(p.boundary.charge), rise = next - last;
  t.elastic += rise * rise / (2 * p.grid.spacing);
  t.steepest = std::fmax(t.steepest, std::fabs(rise));
  const double passed = std::fabs(std::floor(level_of(next)) - std::floor(level_of(last)));
  dislocations += passed;
  if (passed > 0) t.last_site = p.grid.sites - 1;
  if (!t.first_site) t.first_site = t.last_site;
  t.charge = static_cast<double>(p.boundary.charge);
}

/// (all) The first and the last site of all ranks.
void join_sites(const Ranks& ranks, const Totals& own, Totals& t) {
  std::vector<double> mine;
  if (own.first_site) mine = {static_cast<double>(*own.first_site), static_cast<double>(*own.last_site)};
  const std::vector<double> all = ranks.joined(mine);
  if (all.empty()) return;
  t.first_site = static_cast<std::size_t>(all.front());
  t.last_site = static_cast<std::size_t>(all.back());
}

}  // namespace

Totals totals(const Sites& chain) {
  const Problem& p = chain.problem();
  const std::size_t n = p.grid.sites;
  Totals block, t;
  double found = 0, all_found = 0;
  std::vector<double> blocks;  // block by block; added up in order whatever the ranks
  for_own_blocks(chain, 2, chain.time(), [&](const Window& w, std::size_t begin, std::size_t end) {
    add(chain, w, begin, end, block, found);
    for (double* sum : summed(block, found)) blocks.push_back(std::exchange(*sum, 0.0));
  });
  blocks = chain.ranks().joined(blocks);
  for (const double steepest : chain.ranks().joined({block.steepest})) t.steepest = std::fmax(t.steepest, steepest);
  join_sites(chain.ranks(), block, t);
  for (std::size_t i = 0; i < blocks.size(); ++i) *summed(t, all_found)[i % sums] += blocks[i];
  const double first = chain.window(0, 1).u[0], last = chain.window(n - 1, n).u[0];
  t.time = chain.time();
  t.charge = (first - last) / turn;
  if (p.boundary.periodic) close_ring(p, first, last, t, all_found);
  const SpringEnergy springs = chain.spring_energy();
  t.elastic = springs.between_sites.value_or(t.elastic);
  t.loading = springs.loading;
  t.dislocations = std::lround(std::fmin(all_found, 9e18));  // at least this number, of a chain that has diverged
  return t;
}

}  // namespace slipfront::chain
