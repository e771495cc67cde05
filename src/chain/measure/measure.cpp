#include "slipfront/chain/measure.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>

#include "chain/explicit/parts.hpp"
#include "chain/measure/elastic.hpp"
#include "chain/measure/refuse_window.hpp"
#include "foundation/text/digits.hpp"
#include "slipfront/error.hpp"

namespace slipfront::chain {
namespace {

constexpr double turn = 2 * std::numbers::pi;
/// Calls measure(parts, begin, end) for this rank's sites in order, some 16 384 at a time, in stretches that depend on
/// the number of sites alone, and done() behind every block.
template <class Measure, class Done>
void in_blocks(const Chain& chain, const Measure& measure, const Done& done) {
  constexpr std::size_t stretch = 16384;
  auto& parts = Inside::of(chain);
  parts.exchange();
  for (std::size_t block = parts.first_block; block < parts.end_block; ++block) {
    const std::size_t end = parts.blocks.begin(block + 1);
    for (std::size_t begin = parts.blocks.begin(block); begin < end; begin += stretch)
      measure(parts, begin, std::min(begin + stretch, end));
    done();
  }
}

/// Lagrange interpolation of v through the (up to) six sites around r (counted in sites of v).
double between(const std::vector<double>& v, double r) {
  const long n = static_cast<long>(v.size()), points = std::min<long>(6, n);
  const long first = std::clamp<long>(static_cast<long>(std::floor(r)) - points / 2 + 1, 0, n - points);
  double sum = 0;
  for (long a = 0; a < points; ++a) {
    double weight = 1;
    for (long b = 0; b < points; ++b)
      if (b != a) weight *= (r - static_cast<double>(first + b)) / static_cast<double>(a - b);
    sum += weight * v[static_cast<std::size_t>(first + a)];
  }
  return sum;
}

/// Integral of the interpolant over [from, to], in sites: Gauss-Legendre with three points in every interval of the
/// grid.
double integral(const std::vector<double>& v, double from, double to) {
  double sum = 0;
  for (double a = from; a < to;) {
    const double b = std::fmin(std::floor(a) + 1, to), middle = (a + b) / 2, half = (b - a) / 2;
    const double node = std::sqrt(0.6) * half;
    sum += half * (5 * between(v, middle - node) + 8 * between(v, middle) + 5 * between(v, middle + node)) / 9;
    a = b;
  }
  return sum;
}

}  // namespace

void refuse_window(const Grid& grid, double x, double width) {
  throw InputError({.key = "window",
                    .value = digits(x) + " +- " + digits(width / 2),
                    .problem = "not on the chain",
                    .allowed = digits(grid.left) + " to " + digits(grid.x(grid.sites - 1))});
}

Average average(const Chain& chain, double x, double width, double time) {
  const Grid& grid = chain.problem().grid;
  const double last = static_cast<double>(grid.sites - 1);
  const double from = (x - width / 2 - grid.left) / grid.spacing, to = (x + width / 2 - grid.left) / grid.spacing;
  if (!(width > 0) || !(from >= 0) || !(to <= last)) refuse_window(grid, x, width);
  const double begin = std::fmax(0, std::floor(from) - 3), end = std::fmin(last, std::ceil(to) + 3);
  const Window w = chain.window(static_cast<std::size_t>(begin), static_cast<std::size_t>(end) + 1, time);
  const double sites = to - from;
  return {x, width, integral(w.u, from - begin, to - begin) / sites,
          integral(w.velocity, from - begin, to - begin) / sites,
          (between(w.u, from - begin) - between(w.u, to - begin)) / width};
}

namespace {

/// Those between values j and j + 1 of `turns` (u / 2 pi - 1/2), value 0 of which is at x.
void find(const std::vector<double>& turns, std::size_t j, double x, double h, std::vector<Dislocation>& found) {
  const double a = turns[j], b = turns[j + 1];
  const int sign = a > b ? 1 : -1;
  // Whole numbers passed on the way; more than one between two sites only on a lattice of dislocations narrower than A.
  for (double level = sign > 0 ? std::ceil(a) - 1 : std::floor(a) + 1; sign * (level - b) >= 0; level -= sign) {
    double low = static_cast<double>(j), high = low + 1;
    for (int i = 0; i < 50; ++i) {
      const double middle = (low + high) / 2;
      (sign * (between(turns, middle) - level) > 0 ? low : high) = middle;
    }
    found.push_back({x + h * low, sign});
  }
}

}  // namespace

std::vector<Dislocation> dislocations(const Chain& chain) {
  const Problem& p = chain.problem();
  const Grid& grid = p.grid;
  const auto turns = [](std::vector<double> u) {
    for (double& v : u) v = v / turn - 0.5;
    return u;
  };
  std::vector<Dislocation> found;
  in_blocks(
      chain,
      [&](const auto& parts, std::size_t begin, std::size_t end) {
        const std::size_t first = begin < 3 ? 0 : begin - 3, last = std::min(end + 4, grid.sites);
        const std::vector<double> values = turns(parts.window(first, last, chain.time()).u);
        for (std::size_t j = begin; j < std::min(end, grid.sites - 1); ++j)
          find(values, j - first, grid.x(first), grid.spacing, found);
      },
      [] {});
  const Ranks& ranks = Inside::of(chain).ranks;
  if (ranks.size() > 1) {
    std::vector<double> mine;
    for (const Dislocation& d : found) mine.insert(mine.end(), {d.x, static_cast<double>(d.sign)});
    const std::vector<double> all = ranks.joined(mine);
    found.clear();
    for (std::size_t i = 0; i < all.size(); i += 2) found.push_back({all[i], static_cast<int>(all[i + 1])});
  }
  if (p.boundary.periodic) {  // between the last site and the first
    std::vector<double> values = turns(chain.window(grid.sites - 3, grid.sites).u);
    for (const double v : turns(chain.window(0, 3).u)) values.push_back(v - static_cast<double>(p.boundary.charge));
    find(values, 2, grid.x(grid.sites - 3), grid.spacing, found);
  }
  return found;
}

namespace {

/// The sums among the totals, as so many numbers in a row.
constexpr std::size_t sums = 7;
std::array<double*, sums> summed(Totals& t, double& dislocations) {
  return {&t.kinetic, &t.elastic, &t.substrate, &t.momentum, &t.supplied_rate, &t.dissipated_rate, &dislocations};
}

/// Adds sites [begin, end), seen in a window that has two more on either side where there are.
void add(const Chain& chain, const Window& w, std::size_t begin, std::size_t end, Totals& t, double& dislocations) {
  const Problem& p = chain.problem();
  const double h = p.grid.spacing;
  const std::size_t n = p.grid.sites, low = w.begin;
  const auto u = [&](std::size_t j) { return w.u[j - low]; };
  for (std::size_t j = begin; j < end; ++j) {
    const double weight = (j == 0 || j + 1 == n) && !p.boundary.periodic ? h / 2 : h;
    const double velocity = w.velocity[j - low], cosine = std::cos(u(j));
    t.kinetic += weight * velocity * velocity / 2;
    t.substrate += weight * chain.contact_squared(j) * (1 - cosine);
    t.momentum += weight * velocity * w.stress[j - low];
    t.supplied_rate += weight * velocity * chain.forcing(j);
    t.dissipated_rate += weight * velocity * chain.friction(j, velocity);
    t.elastic += h * elastic_energy(u, j, n, h, p.model);
    if (j + 1 >= n) continue;
    dislocations += std::fabs(std::floor(u(j + 1) / turn - 0.5) - std::floor(u(j) / turn - 0.5));
    t.steepest = std::fmax(t.steepest, std::fabs(u(j + 1) - u(j)));
  }
}

}  // namespace

Totals totals(const Chain& chain) {
  const Problem& p = chain.problem();
  const std::size_t n = p.grid.sites;
  Totals block, t;
  double found = 0, all_found = 0;
  std::vector<double> blocks;  // block by block; added up in order whatever the ranks
  in_blocks(
      chain,
      [&](const auto& parts, std::size_t begin, std::size_t end) {
        const Window w = parts.window(begin < 2 ? 0 : begin - 2, std::min(end + 2, n), chain.time());
        add(chain, w, begin, end, block, found);
      },
      [&] {
        for (double* sum : summed(block, found)) blocks.push_back(std::exchange(*sum, 0.0));
      });
  blocks = Inside::of(chain).ranks.joined(blocks);
  for (const double steepest : Inside::of(chain).ranks.joined({block.steepest}))
    t.steepest = std::fmax(t.steepest, steepest);
  for (std::size_t i = 0; i < blocks.size(); ++i) *summed(t, all_found)[i % sums] += blocks[i];
  const double first = chain.window(0, 1).u[0], last = chain.window(n - 1, n).u[0];
  t.time = chain.time();
  if (const auto& steps = Inside::of(chain).implicit) {  // the energy that its steps keep
    t.elastic = steps->elastic_energy();
    t.loading = steps->loading_energy();
  }
  t.charge = (first - last) / turn;
  if (p.boundary.periodic) {
    const double rise = first - turn * static_cast<double>(p.boundary.charge) - last;
    if (!Inside::of(chain).implicit) t.elastic += rise * rise / (2 * p.grid.spacing);
    t.steepest = std::fmax(t.steepest, std::fabs(rise));
    all_found += std::fabs(std::floor((last + rise) / turn - 0.5) - std::floor(last / turn - 0.5));
    t.charge = static_cast<double>(p.boundary.charge);
  }
  t.dislocations = std::lround(std::fmin(all_found, 9e18));  // of a chain that has blown up, at least so many
  return t;
}

void Work::sample(const Totals& now) {
  if (started) {
    const double half = (now.time - time) / 2;
    supplied += half * (supplied_rate + now.supplied_rate);
    dissipated += half * (dissipated_rate + now.dissipated_rate);
  }
  started = true;
  time = now.time;
  supplied_rate = now.supplied_rate;
  dissipated_rate = now.dissipated_rate;
}

}  // namespace slipfront::chain
