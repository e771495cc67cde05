#include "lattice/chain/observe/averages.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "lattice/chain/observe/totals.hpp"
#include "math/constants.hpp"
#include "math/digits.hpp"
#include "math/interpolation.hpp"
#include "math/roots.hpp"
#include "slipfront/error.hpp"
#include "slipfront/theory/train.hpp"

namespace slipfront::chain {

double level_of(double u) { return u / turn - 0.5; }

namespace {

std::vector<double> levels_of(std::vector<double> u) {
  for (double& v : u) v = level_of(v);
  return u;
}

/// The position of a dislocation is interpolated between this many sites around it, whatever window a caller has.
constexpr std::size_t interpolated_sites = 8;
/// The first of them for a dislocation between site j and the next of n sites.
std::size_t first_next_to(std::size_t j, std::size_t n) {
  return std::min(j < 3 ? 0 : j - 3, n < interpolated_sites ? 0 : n - interpolated_sites);
}

/// Adds those between values j and j + 1 of `levels`; value 0 is at x.
void find(std::span<const double> levels, std::size_t j, double x, double h, std::vector<Dislocation>& found) {
  const double from = std::floor(levels[j]), to = std::floor(levels[j + 1]);
  const int sign = from > to ? 1 : -1;
  // Between two sites u passes more than one whole number only on a lattice of dislocations that are narrower than A.
  for (double level = sign > 0 ? from : from + 1; sign > 0 ? level > to : level <= to; level -= sign) {
    const auto is_before = [&](double at) { return sign * (interpolated(levels, at) - level) > 0; };
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

std::vector<Dislocation> dislocations_after(const Sites& chain, std::size_t j, double time) {
  const Problem& p = chain.problem();
  const std::size_t n = p.grid.sites;
  const bool seam = p.boundary.periodic && j + 1 == n;
  const std::size_t first = seam ? n - 4 : first_next_to(j, n);
  std::vector<double> u = chain.window(first, std::min(first + interpolated_sites, n), time).u;
  if (seam)
    for (const double v : chain.window(0, 4, time).u) u.push_back(v - turn * static_cast<double>(p.boundary.charge));
  std::vector<Dislocation> found;
  find(levels_of(u), j - first, p.grid.x(first), p.grid.spacing, found);
  return found;
}

std::vector<Dislocation> dislocations(const Sites& chain, double time) {
  const Grid& grid = chain.problem().grid;
  std::vector<Dislocation> found;
  for_own_blocks(chain, 4, time, [&](const Window& w, std::size_t begin, std::size_t end) {
    const std::vector<double> levels = levels_of(w.u);
    for (std::size_t j = begin; j < std::min(end, grid.sites - 1); ++j) {
      const std::size_t first = first_next_to(j, grid.sites), size = std::min(interpolated_sites, grid.sites);
      find(std::span(levels).subspan(first - w.begin, size), j - first, grid.x(first), grid.spacing, found);
    }
  });
  found = joined(chain.ranks(), found);
  if (!chain.problem().boundary.periodic) return found;
  const std::vector<Dislocation> last = dislocations_after(chain, grid.sites - 1, time);
  found.insert(found.end(), last.begin(), last.end());
  return found;
}

std::vector<Dislocation> dislocations(const Sites& chain) { return dislocations(chain, chain.time()); }

std::vector<double> displacements(const Sites& chain, double time) {
  std::vector<double> mine;
  for_own_blocks(chain, 0, time, [&](const Window& w, std::size_t begin, std::size_t end) {
    const double* const u = w.u.data() + (begin - w.begin);
    mine.insert(mine.end(), u, u + (end - begin));
  });
  return chain.ranks().joined_at_first(mine);
}

namespace {

/// The first of up to six sites around r, of `size` sites.
long first_around(double r, long size, long points) {
  return std::clamp<long>(static_cast<long>(std::floor(r)) - points / 2 + 1, 0, size - points);
}

/// Adds `share` times the weights of the values around r in the interpolant there.
void add_interpolation(double r, double share, std::vector<double>& weights) {
  const long size = static_cast<long>(weights.size()), points = std::min<long>(6, size),
             first = first_around(r, size, points);
  const auto of_values = equidistant_weights(static_cast<std::size_t>(points), r - static_cast<double>(first));
  for (std::size_t j = 0; j < static_cast<std::size_t>(points); ++j)
    weights[static_cast<std::size_t>(first) + j] += share * of_values[j];
}

}  // namespace

double interpolated(std::span<const double> v, double r) {
  const long size = static_cast<long>(v.size()), points = std::min<long>(6, size),
             first = first_around(r, size, points);
  const auto weights = equidistant_weights(static_cast<std::size_t>(points), r - static_cast<double>(first));
  double sum = 0;
  for (std::size_t j = 0; j < static_cast<std::size_t>(points); ++j)
    sum += weights[j] * v[static_cast<std::size_t>(first) + j];
  return sum;
}

double SiteWeights::operator()(std::span<const double> values) const {
  double sum = 0;
  for (std::size_t j = 0; j < weights.size(); ++j) sum += weights[j] * values[j];
  return sum;
}

void refuse_window(const Grid& grid, double x, double width) {
  throw InputError({.key = "window",
                    .value = digits(x) + " +- " + digits(width / 2),
                    .problem = "not on the chain",
                    .allowed = digits(grid.left) + " to " + digits(grid.x(grid.sites - 1))});
}

namespace {

/// Sites of a chain at a time: those that are known already, or those that are asked for.
class SomeSites {
 public:
  SomeSites(const Sites& chain, std::size_t begin, std::size_t end, double time)
      : begin_(begin), size_(end - begin), known_(chain.known()) {
    if (known_ == nullptr) found_ = chain.window(begin, end, time);
  }
  const Window& window() const { return known_ != nullptr ? *known_ : found_; }
  std::span<const double> operator()(std::vector<double> Window::*values) const {
    return std::span(window().*values).subspan(begin_ - window().begin, size_);
  }

 private:
  std::size_t begin_, size_;
  const Window* known_;
  Window found_;
};

/// The ends of a window in sites, of which the first sites that count are `begin` and `end`.
struct Ends {
  double from, to;
  std::size_t begin, end;
};

Ends ends_of_window(const Grid& grid, double x, double width) {
  const double last = static_cast<double>(grid.sites - 1);
  const double from = (x - width / 2 - grid.left) / grid.spacing, to = (x + width / 2 - grid.left) / grid.spacing;
  if (!(width > 0) || !(from >= 0) || !(to <= last)) refuse_window(grid, x, width);
  const double begin = std::fmax(0, std::floor(from) - 3), end = std::fmin(last, std::ceil(to) + 3);
  return {from - begin, to - begin, static_cast<std::size_t>(begin), static_cast<std::size_t>(end) + 1};
}

}  // namespace

SiteWeights weights_of_mean(const Grid& grid, double x, double width) {
  const Ends ends = ends_of_window(grid, x, width);
  SiteWeights mean{ends.begin, std::vector<double>(ends.end - ends.begin)};
  for (double a = ends.from; a < ends.to;) {  // Gauss-Legendre with three points in every interval of the grid
    const double b = std::fmin(std::floor(a) + 1, ends.to), middle = (a + b) / 2, half = (b - a) / 2;
    const double node = std::sqrt(0.6) * half, share = half / 9 / (ends.to - ends.from);
    add_interpolation(middle - node, 5 * share, mean.weights);
    add_interpolation(middle, 8 * share, mean.weights);
    add_interpolation(middle + node, 5 * share, mean.weights);
    a = b;
  }
  return mean;
}

Average average(const Sites& chain, double x, double width, double time) {
  const Grid& grid = chain.problem().grid;
  const Ends ends = ends_of_window(grid, x, width);
  const SiteWeights mean = weights_of_mean(grid, x, width);
  const SomeSites sites(chain, ends.begin, ends.end, time);
  const std::span<const double> u = sites(&Window::u);
  return {x, width, mean(u), mean(sites(&Window::velocity)),
          (interpolated(u, ends.from) - interpolated(u, ends.to)) / width};
}

double average_displacement(const Sites& chain, const SiteWeights& mean, double time) {
  return mean(SomeSites(chain, mean.begin, mean.end(), time)(&Window::u));
}

double average_displacement(const Sites& chain, double x, double width, double time) {
  return average_displacement(chain, weights_of_mean(chain.problem().grid, x, width), time);
}

namespace {

struct Range {
  std::size_t begin, end;
};

/// With two more sites on either side, as far as there are any, for the elastic energy.
Range with_neighbours(const Grid& grid, const Range& r) {
  return {r.begin < 2 ? 0 : r.begin - 2, std::min(r.end + 2, grid.sites)};
}

Range around(const Grid& grid, double x, double width) {
  const double last = static_cast<double>(grid.sites - 1);
  const double from = std::fmax(0, std::ceil((x - width / 2 - grid.left) / grid.spacing));
  const double to = std::fmin(last, std::floor((x + width / 2 - grid.left) / grid.spacing));
  if (!(width > 0) || !(from <= to)) refuse_window(grid, x, width);
  return {static_cast<std::size_t>(from), static_cast<std::size_t>(to) + 1};
}

/// Windows are up to these many factors of sqrt(2) narrower and wider than the one whose error they measure.
constexpr int narrower = 2, wider = 2;
/// In 108 averages at x = 0 of steps between stressed sides, at scales from 500 to 8000, this factor of the change
/// covers all errors; a factor of 1 covers 92 % of those of the step from 0.855 to 0.179.
constexpr double safety_of_change = 1.5;

/// Whether the window around x is on the chain.
bool is_whole(const Grid& grid, double x, double width) {
  return x - width / 2 >= grid.left && x + width / 2 <= grid.x(grid.sites - 1);
}

}  // namespace

double energy_density(const Problem& p, const Window& w, std::size_t j) {
  const std::size_t i = j - w.begin;
  const auto u = [&](std::size_t site) { return w.u[site - w.begin]; };
  return w.velocity[i] * w.velocity[i] / 2 + w.contact_squared[i] * (1 - std::cos(w.u[i])) +
         elastic_energy(u, j, p.grid.sites, p.grid.spacing, p.model);
}

/// The weight and its slope vanish at the ends: the sum over sites is as good as the integral.
SiteWeights weights_of_smooth_mean(const Grid& grid, double x, double width) {
  const Range sites = around(grid, x, width);
  SiteWeights mean{sites.begin, {}};
  double sum = 0;
  for (std::size_t j = sites.begin; j < sites.end; ++j) {
    mean.weights.push_back(1 + std::cos(2 * std::numbers::pi * (grid.x(j) - x) / width));
    sum += mean.weights.back();
  }
  if (sum > 0)  // it is 0 at a single site at the very end of the window
    for (double& weight : mean.weights) weight /= sum;
  return mean;
}

SmoothAverage smooth_average(const Sites& chain, const SiteWeights& mean, double time) {
  const Range all = with_neighbours(chain.problem().grid, {mean.begin, mean.end()});
  return smooth_average(chain, SomeSites(chain, all.begin, all.end, time).window(), mean);
}

SmoothAverage smooth_average(const Sites& chain, double x, double width, double time) {
  return smooth_average(chain, weights_of_smooth_mean(chain.problem().grid, x, width), time);
}

SmoothAverage smooth_average(const Sites& chain, const Window& w, const SiteWeights& mean) {
  SmoothAverage a{};
  for (std::size_t j = mean.begin; j < mean.end(); ++j) {
    const std::size_t i = j - w.begin;
    const double weight = mean.weights[j - mean.begin];
    a.velocity += weight * w.velocity[i];
    a.stress += weight * w.stress[i];
    a.energy += weight * (w.energy.empty() ? energy_density(chain.problem(), w, j) : w.energy[i]);
  }
  return a;
}

BestAverage best_average(const Sites& chain, double x, double least, double most, double time) {
  const Grid& grid = chain.problem().grid;
  const auto width_of = [&](int i) { return least * std::exp2(0.5 * i); };
  int candidates = 1, last = 0;  // the first window may be cut by an end, others not
  while (width_of(candidates) <= most * (1 + 1e-9) && is_whole(grid, x, width_of(candidates + wider))) ++candidates;
  while (last < candidates - 1 + wider && is_whole(grid, x, width_of(last + 1))) ++last;
  const Range all = with_neighbours(grid, around(grid, x, width_of(last)));
  const SomeSites sites(chain, all.begin, all.end, time);
  std::vector<SmoothAverage> averages;  // the first is that of width_of(-narrower)
  for (int i = -narrower; i <= last; ++i)
    averages.push_back(i < 0 && width_of(i) < 2 * grid.spacing
                           ? SmoothAverage{none, none, none}
                           : smooth_average(chain, sites.window(), weights_of_smooth_mean(grid, x, width_of(i))));
  const auto average_at = [&](int i) -> const SmoothAverage& { return *(averages.begin() + narrower + i); };
  BestAverage best{};
  for (int i = 0; i < candidates; ++i) {
    const SmoothAverage& here = average_at(i);
    BestAverage tried{here, width_of(i), none, none};
    for (int j = i - narrower; j <= std::min(i + wider, last); ++j) {
      const SmoothAverage& other = average_at(j);
      if (j == i || std::isnan(other.velocity)) continue;
      tried.velocity_error =
          std::fmax(tried.velocity_error, safety_of_change * std::fabs(other.velocity - here.velocity));
      tried.stress_error = std::fmax(tried.stress_error, safety_of_change * std::fabs(other.stress - here.stress));
    }
    if (i == 0 || tried.velocity_error < best.velocity_error) best = tried;
  }
  return best;
}

double energy_of_train(double stress, double velocity, double contact) {
  if (contact != 1) return contact * contact * energy_of_train(stress / contact, velocity / contact);
  const double gamma2 = 1 - velocity * velocity / (stress * stress);
  if (!(stress > 0 && gamma2 > 0)) return 0;          // no train: all the energy is in phonons
  const double at_rest = stress * std::sqrt(gamma2);  // Eq. 4: a moving train is contracted
  if (at_rest < 2 * train::smallest_stress) return 4 / std::numbers::pi * stress / std::sqrt(gamma2);  // 8 each
  State state = train::at_rest(at_rest);
  state.phi = std::atanh(velocity / stress);
  return train::averages(state).H;
}

}  // namespace slipfront::chain
