#include <algorithm>
#include <cmath>
#include <numbers>

#include "foundation/text/digits.hpp"
#include "plane/direct/sites.hpp"
#include "slipfront/elliptic/jacobi.hpp"
#include "slipfront/error.hpp"
#include "slipfront/train/train.hpp"

namespace slipfront::plane {
namespace {

using std::numbers::pi;

/// A held site takes the density of a site so many rows away.
constexpr int passes = 4;
/// The start of a row depends on so many rows on each side: those of the density, and one more for its slope.
constexpr std::size_t reach = passes + 1;

/// The mean slip, stretched, at each site.
std::vector<double> mean_slip(const Problem& problem, const Sites& sites) {
  std::vector<double> mean(sites.size(), 0.0);
  for (std::size_t j = 0; j < sites.ny; ++j)
    for (std::size_t i = 0; i < sites.nx; ++i) {
      const double x = sites.x(i), y = sites.y(j), slip = problem.slip(x, y);
      if (!(slip >= 0 && std::isfinite(slip)))
        throw InputError({.key = "slip",
                          .value = digits(slip),
                          .problem = "not a slip at x = " + digits(x, 4) + ", y = " + digits(y, 4),
                          .allowed = "a finite number >= 0"});
      mean[sites.at(i, j)] = sites.scale * slip;
    }
  return mean;
}

/// A difference over one or two spacings, that of the two sites which falls more steeply, so that the slip next to a
/// plateau or to the edge of the rupture keeps its slope.
double slope(double before, double here, double after, double h) {
  const double a = (here - before) / h, b = (after - here) / h;
  const bool even = std::fabs(a - b) < 0.2 * std::fmax(std::fabs(a), std::fabs(b));
  return even ? (a + b) / 2 : std::fabs(a) > std::fabs(b) ? a : b;
}

/// The density of lines at each site: the gradient of the mean slip.
std::vector<double> densities(const std::vector<double>& mean, const Sites& sites) {
  std::vector<double> density(sites.size(), 0.0);
  for (std::size_t j = 0; j < sites.ny; ++j)
    for (std::size_t i = 0; i < sites.nx; ++i) {
      const std::size_t c = sites.at(i, j), n = sites.stride();
      const double west = i > 0 ? mean[c - 1] : mean[c], east = i + 1 < sites.nx ? mean[c + 1] : mean[c];
      const double south = j > 0 ? mean[c - n] : mean[c], north = j + 1 < sites.ny ? mean[c + n] : mean[c];
      density[c] = std::hypot(slope(west, mean[c], east, sites.hx), slope(south, mean[c], north, sites.hy));
    }
  return density;
}

/// Gives held sites next to the lines the density of these lines, because the slip of a held region has no slope, or
/// only a part of it next to the edge.
void extend_into_held(const Sites& sites, std::vector<double>& density) {
  if (sites.moves.empty()) return;
  const std::size_t n = sites.stride();
  for (std::size_t j = 0; j < sites.ny; ++j)
    for (std::size_t i = 0; i < sites.nx; ++i) {
      const std::size_t c = sites.at(i, j);
      if (sites.moves[c] != 0) continue;
      double next_to_it = 0;
      for (const std::size_t other : {c - 1, c + 1, c - n, c + n})
        next_to_it = std::fmax(next_to_it, density[other] * sites.moves[other]);
      if (next_to_it > 0) density[c] = next_to_it;
    }
  for (int pass = 1; pass < passes; ++pass) {
    const std::vector<double> before = density;
    for (std::size_t j = 0; j < sites.ny; ++j)
      for (std::size_t i = 0; i < sites.nx; ++i)
        if (const std::size_t c = sites.at(i, j); sites.moves[c] == 0 && before[c] == 0)
          density[c] = std::max({before[c - 1], before[c + 1], before[c - n], before[c + n]});
  }
}

/// u of the train with the density `k`, in local units, whose mean is `mean`. Lines are at odd multiples of pi.
double train_of(double k, double mean) {
  const double wells = std::floor(mean / (2 * pi)), phase = mean - 2 * pi * wells;
  if (k < train::smallest_stress) return 2 * pi * (phase < pi ? wells : wells + 1);
  const elliptic::AtPsi at = elliptic::at_psi(train::psi_of_stress(k));
  return 2 * pi * wells + 2 * elliptic::jacobi(at.K * (1 - phase / pi), at).coamplitude;
}

/// The start of the rows of `sites`, a part of the rows of `wide`.
Start in_band(const Problem& problem, const Sites& wide, const Sites& sites) {
  const std::vector<double> mean = mean_slip(problem, wide);
  std::vector<double> density = densities(mean, wide);
  extend_into_held(wide, density);
  Start start{.u = std::vector<double>(sites.size(), 0.0)};
  for (std::size_t j = 0; j < sites.ny; ++j)
    for (std::size_t i = 0; i < sites.nx; ++i) {
      const std::size_t c = wide.at(i, j + sites.first_row - wide.first_row);
      const double k = density[c] / (wide.contact2.empty() ? 1 : std::sqrt(wide.contact2[c]));
      start.u[sites.at(i, j)] = train_of(k, mean[c]);
      start.largest_density = std::fmax(start.largest_density, k);
    }
  return start;
}

}  // namespace

Start lines_at_rest(const Problem& problem, const Sites& sites) {
  if (sites.has_bottom() && sites.has_top()) return in_band(problem, sites, sites);
  return in_band(problem, widened(problem, sites, reach), sites);
}

}  // namespace slipfront::plane
