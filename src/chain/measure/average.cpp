#include "chain/measure/average.hpp"

#include <cmath>

#include "chain/measure/interpolation.hpp"

namespace slipfront::chain {

Average average(const Sites& chain, double x, double width, double time) {
  const Grid& grid = chain.problem().grid;
  const double last = static_cast<double>(grid.sites - 1);
  const double from = (x - width / 2 - grid.left) / grid.spacing, to = (x + width / 2 - grid.left) / grid.spacing;
  if (!(width > 0) || !(from >= 0) || !(to <= last)) refuse_window(grid, x, width);
  const double begin = std::fmax(0, std::floor(from) - 3), end = std::fmin(last, std::ceil(to) + 3);
  const Window w = chain.window(static_cast<std::size_t>(begin), static_cast<std::size_t>(end) + 1, time);
  const double sites = to - from;
  return {x, width, integral(w.u, from - begin, to - begin) / sites,
          integral(w.velocity, from - begin, to - begin) / sites,
          (interpolated(w.u, from - begin) - interpolated(w.u, to - begin)) / width};
}

}  // namespace slipfront::chain
