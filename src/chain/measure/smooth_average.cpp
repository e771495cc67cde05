#include "chain/measure/smooth_average.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "chain/measure/elastic.hpp"
#include "chain/measure/interpolation.hpp"
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
