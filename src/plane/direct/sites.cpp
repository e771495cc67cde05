#include "plane/direct/sites.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "foundation/text/digits.hpp"
#include "slipfront/error.hpp"

namespace slipfront::plane {
namespace {

constexpr double most_sites = 1e10;

InputError refusal(const char* key, double value, const char* problem, const char* allowed) {
  return InputError({.key = key, .value = digits(value), .problem = problem, .allowed = allowed});
}

/// The largest contact ratio on a grid of samples.
double largest_contact(const Problem& p) {
  if (!p.contact) return 1;
  constexpr int samples = 200;
  double largest = 0;
  for (int j = 0; j <= samples; ++j)
    for (int i = 0; i <= samples; ++i)
      largest = std::fmax(
          largest, p.contact(p.left + (p.right - p.left) * i / samples, p.bottom + (p.top - p.bottom) * j / samples));
  return largest;
}

template <class Value>
std::vector<double> at_each(const Sites& sites, const Value& value) {
  std::vector<double> all(sites.size(), 0.0);
  sites.for_each_in_reach([&](std::size_t at, double x, double y) { all[at] = value(x, y); });
  return all;
}

void fix_edges(Sites& sites) {
  if (sites.moves.empty()) sites.moves = at_each(sites, [](double, double) { return 1.0; });
  const auto ghosts = static_cast<std::ptrdiff_t>(Sites::ghost_rows), rows = static_cast<std::ptrdiff_t>(sites.ny);
  for (std::ptrdiff_t row = -ghosts; row < rows + ghosts; ++row) {
    double* const moves = &sites.moves[sites.start_of(row)];
    if (sites.on_edge(row)) std::fill_n(moves, sites.nx, 0.0);
    moves[0] = moves[sites.nx - 1] = 0;
  }
}

/// Finds what acts on each site.
void fill(const Problem& p, Sites& sites) {
  if (p.contact)
    sites.contact2 = at_each(sites, [&](double x, double y) {
      const double a = p.contact(x, y);
      return a * a;
    });
  if (p.friction.is_viscous())
    sites.viscous =
        at_each(sites, [&](double x, double y) { return *p.friction.linear_coefficient(x, y) / sites.scale; });
  if (p.fixed) sites.moves = at_each(sites, [&](double x, double y) { return p.fixed(x, y) == 0 ? 1.0 : 0.0; });
  if (p.edges == Edges::fixed) fix_edges(sites);
}

/// The first row of a band.
std::size_t first_of(int number, int bands, std::size_t rows) {
  return rows * static_cast<std::size_t>(number) / static_cast<std::size_t>(bands);
}

}  // namespace

Counts count_sites(const Problem& p, double scale, double spacing) {
  assert(scale > 0 && std::isfinite(scale));
  if (!(spacing > 0 && spacing <= 0.5)) throw refusal("spacing", spacing, "out of range", "> 0 and <= 0.5");
  const double widest = spacing / largest_contact(p);
  const Counts n{std::ceil((p.right - p.left) * scale / widest), std::ceil((p.top - p.bottom) * scale / widest)};
  if (!(n.nx >= 4 && n.ny >= 4)) throw refusal("scale", scale, "fewer than 4 x 4 sites", "a larger scale");
  if (!(n.nx * n.ny <= most_sites)) throw refusal("scale", scale, "more than ten billion sites", "a smaller scale");
  return n;
}

Sites make_sites(const Problem& p, double scale, double spacing, Band band) {
  const auto [nx, ny] = count_sites(p, scale, spacing);
  Sites sites;
  sites.nx = static_cast<std::size_t>(nx);
  sites.all_rows = static_cast<std::size_t>(ny);
  if (!(sites.all_rows >= Sites::ghost_rows * static_cast<std::size_t>(band.bands)))
    throw refusal("ranks", band.bands, "too many for so few rows of sites", "a rank for each four rows, or fewer");
  sites.first_row = first_of(band.number, band.bands, sites.all_rows);
  sites.ny = first_of(band.number + 1, band.bands, sites.all_rows) - sites.first_row;
  sites.scale = scale;
  sites.left = p.left;
  sites.bottom = p.bottom;
  sites.hx = (p.right - p.left) * scale / nx;
  sites.hy = (p.top - p.bottom) * scale / ny;
  fill(p, sites);
  return sites;
}

Sites widened(const Problem& p, const Sites& sites, std::size_t rows) {
  Sites wide = sites;
  wide.first_row -= std::min(rows, sites.first_row);
  wide.ny = std::min(sites.first_row + sites.ny + rows, sites.all_rows) - wide.first_row;
  fill(p, wide);
  return wide;
}

}  // namespace slipfront::plane
