#include "slipfront/chain/smooth.hpp"

#include <cmath>
#include <numbers>

#include "refuse_window.hpp"

namespace slipfront::chain {

Average smooth_average(const Chain& chain, double x, double width, double time) {
  const Grid& grid = chain.problem().grid;
  const double last = static_cast<double>(grid.sites - 1);
  const double from = std::fmax(0, std::ceil((x - width / 2 - grid.left) / grid.spacing));
  const double to = std::fmin(last, std::floor((x + width / 2 - grid.left) / grid.spacing));
  if (!(width > 0) || !(from <= to)) refuse_window(grid, x, width);
  const Window w = chain.window(static_cast<std::size_t>(from), static_cast<std::size_t>(to) + 1, time);
  // The weight and its slope vanish at the ends: the sum over sites is as good as the integral.
  Average a{x, width, 0, 0, 0};
  double sum = 0;
  for (std::size_t i = 0; i < w.u.size(); ++i) {
    const double weight = 1 + std::cos(2 * std::numbers::pi * (w.x[i] - x) / width);
    sum += weight;
    a.u += weight * w.u[i];
    a.velocity += weight * w.velocity[i];
    a.stress += weight * w.stress[i];
  }
  if (!(sum > 0)) sum = 1;  // a single site, at the very end of the window
  a.u /= sum;
  a.velocity /= sum;
  a.stress /= sum;
  return a;
}

}  // namespace slipfront::chain
