// What a run sees of contacts and pores that change with the state of friction.

#include <algorithm>
#include <cmath>
#include <limits>

#include "slipfront/chain/run.hpp"

namespace slipfront::chain {

/// a at a place of the scenario, as it is now.
double Run::contact_at(double x) const {
  const Grid& grid = chain_.problem().grid;
  if (!chain_.problem().friction.contacts().act()) return scaled_.contact ? scaled_.contact(x) : 1.0;
  const double site =
      std::clamp((x * scaled_.scale - grid.left) / grid.spacing, 0.0, static_cast<double>(grid.sites - 1));
  return std::sqrt(chain_.contact_squared(static_cast<std::size_t>(std::lround(site))));
}

/// p, on the mean over the window of the slip at x = 0.
double Run::pore_pressure_at_origin() const {
  if (std::isnan(first_u_at_origin_)) return std::numeric_limits<double>::quiet_NaN();
  const Grid& grid = chain_.problem().grid;
  const double half = scaled_.scale * window_ / 2;
  double count = 0, sum = 0;
  const auto from = static_cast<std::size_t>(std::ceil((-half - grid.left) / grid.spacing));
  for (std::size_t j = from; j < grid.sites && (count == 0 || grid.x(j) <= half); ++j, ++count)
    sum += chain_.effective_stress(j);
  return 1 - sum / count;
}

}  // namespace slipfront::chain
