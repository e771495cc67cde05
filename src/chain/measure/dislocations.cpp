#include "chain/measure/dislocations.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "chain/measure/interpolation.hpp"
#include "chain/measure/own_sites.hpp"
#include "foundation/math/roots.hpp"

namespace slipfront::chain {
namespace {

/// u / 2 pi - 1/2: dislocations are at whole numbers.
std::vector<double> turns(std::vector<double> u) {
  for (double& v : u) v = v / (2 * std::numbers::pi) - 0.5;
  return u;
}

/// Adds those between values j and j + 1 of `turns`; value 0 is at x.
void find(const std::vector<double>& turns, std::size_t j, double x, double h, std::vector<Dislocation>& found) {
  const double a = turns[j], b = turns[j + 1];
  const int sign = a > b ? 1 : -1;
  // Between two sites u passes more than one whole number only on a lattice of dislocations that are narrower than A.
  for (double level = sign > 0 ? std::ceil(a) - 1 : std::floor(a) + 1; sign * (level - b) >= 0; level -= sign) {
    const auto is_before = [&](double at) { return sign * (interpolated(turns, at) - level) > 0; };
    const auto site = static_cast<double>(j);
    const double at = bisected({.holding = site, .failing = site + 1}, is_before, 50).holding;
    found.push_back({x + h * at, sign, std::lround(level)});
  }
}

/// (all) Those of all ranks.
std::vector<Dislocation> joined(const Ranks& ranks, const std::vector<Dislocation>& found) {
  if (ranks.size() == 1) return found;
  std::vector<double> mine;
  for (const Dislocation& d : found)
    mine.insert(mine.end(), {d.x, static_cast<double>(d.sign), static_cast<double>(d.level)});
  const std::vector<double> numbers = ranks.joined(mine);
  std::vector<Dislocation> all;
  for (std::size_t i = 0; i < numbers.size(); i += 3)
    all.push_back({numbers[i], static_cast<int>(numbers[i + 1]), std::lround(numbers[i + 2])});
  return all;
}

}  // namespace

std::vector<Dislocation> dislocations(const Sites& chain, double time) {
  const Problem& p = chain.problem();
  const Grid& grid = p.grid;
  std::vector<Dislocation> found;
  for_own_sites(
      chain,
      [&](std::size_t begin, std::size_t end) {
        const std::size_t first = begin < 3 ? 0 : begin - 3, last = std::min(end + 4, grid.sites);
        const std::vector<double> values = turns(chain.own_window(first, last, time).u);
        for (std::size_t j = begin; j < std::min(end, grid.sites - 1); ++j)
          find(values, j - first, grid.x(first), grid.spacing, found);
      },
      [] {});
  found = joined(chain.ranks(), found);
  if (p.boundary.periodic) {  // between the last site and the first
    std::vector<double> values = turns(chain.window(grid.sites - 3, grid.sites, time).u);
    for (const double v : turns(chain.window(0, 3, time).u))
      values.push_back(v - static_cast<double>(p.boundary.charge));
    find(values, 2, grid.x(grid.sites - 3), grid.spacing, found);
  }
  return found;
}

std::vector<Dislocation> dislocations(const Sites& chain) { return dislocations(chain, chain.time()); }

std::vector<double> displacements(const Sites& chain, double time) {
  std::vector<double> mine;
  for_own_sites(
      chain,
      [&](std::size_t begin, std::size_t end) {
        const std::vector<double> u = chain.own_window(begin, end, time).u;
        mine.insert(mine.end(), u.begin(), u.end());
      },
      [] {});
  return chain.ranks().joined_at_first(mine);
}

}  // namespace slipfront::chain
