#include "chain/measure/smooth_average.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "chain/measure/elastic.hpp"
#include "chain/measure/interpolation.hpp"
#include "foundation/math/constants.hpp"
#include "slipfront/train/train.hpp"

namespace slipfront::chain {

namespace {

struct Range {
  std::size_t begin, end;  ///< with weight
  std::size_t low, high;   ///< two more on either side, for the elastic energy
};

Range around(const Grid& grid, double x, double width) {
  const double last = static_cast<double>(grid.sites - 1);
  const double from = std::fmax(0, std::ceil((x - width / 2 - grid.left) / grid.spacing));
  const double to = std::fmin(last, std::floor((x + width / 2 - grid.left) / grid.spacing));
  if (!(width > 0) || !(from <= to)) refuse_window(grid, x, width);
  const auto begin = static_cast<std::size_t>(from), end = static_cast<std::size_t>(to) + 1;
  return {begin, end, begin < 2 ? 0 : begin - 2, std::min(end + 2, grid.sites)};
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

SmoothAverage smooth_average(const Sites& chain, double x, double width, double time) {
  const Range sites = around(chain.problem().grid, x, width);
  return smooth_average(chain, chain.window(sites.low, sites.high, time), x, width);
}

SmoothAverage smooth_average(const Sites& chain, const Window& w, double x, double width) {
  const Grid& grid = chain.problem().grid;
  const Range sites = around(grid, x, width);
  if (sites.low < w.begin || sites.high > w.begin + w.x.size()) refuse_window(grid, x, width);
  const auto u = [&](std::size_t j) { return w.u[j - w.begin]; };
  // The weight and its slope vanish at the ends: the sum over sites is as good as the integral.
  SmoothAverage a{};
  double sum = 0;
  for (std::size_t j = sites.begin; j < sites.end; ++j) {
    const std::size_t i = j - w.begin;
    const double weight = 1 + std::cos(2 * std::numbers::pi * (w.x[i] - x) / width);
    sum += weight;
    a.velocity += weight * w.velocity[i];
    a.stress += weight * w.stress[i];
    a.energy += weight * (w.velocity[i] * w.velocity[i] / 2 + w.contact_squared[i] * (1 - std::cos(u(j))) +
                          elastic_energy(u, j, grid.sites, grid.spacing, chain.problem().model));
  }
  if (!(sum > 0)) sum = 1;  // a single site, at the very end of the window
  a.velocity /= sum;
  a.stress /= sum;
  a.energy /= sum;
  return a;
}

BestAverage best_average(const Sites& chain, double x, double least, double most, double time) {
  const Grid& grid = chain.problem().grid;
  const auto width_of = [&](int i) { return least * std::exp2(0.5 * i); };
  int candidates = 1, last = 0;  // the first window may be cut by an end, others not
  while (width_of(candidates) <= most * (1 + 1e-9) && is_whole(grid, x, width_of(candidates + wider))) ++candidates;
  while (last < candidates - 1 + wider && is_whole(grid, x, width_of(last + 1))) ++last;
  const Range all = around(grid, x, width_of(last));
  const Window sites = chain.window(all.low, all.high, time);
  std::vector<SmoothAverage> averages;  // the first is that of width_of(-narrower)
  for (int i = -narrower; i <= last; ++i)
    averages.push_back(i < 0 && width_of(i) < 2 * grid.spacing ? SmoothAverage{none, none, none}
                                                               : smooth_average(chain, sites, x, width_of(i)));
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
