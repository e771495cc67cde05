#include "chain/model/start_check.hpp"

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "chain/model/blocks.hpp"
#include "foundation/math/constants.hpp"
#include "foundation/text/digits.hpp"
#include "slipfront/error.hpp"

namespace slipfront::chain {
namespace {

[[noreturn]] void refuse_size(std::size_t size, const std::string& allowed) {
  throw InputError({.key = "initial motion",
                    .value = std::to_string(size) + " sites",
                    .problem = "does not fit the grid",
                    .allowed = allowed + " sites"});
}

std::vector<double> part(const std::vector<double>& all, std::size_t begin, std::size_t end) {
  const auto at = [&](std::size_t j) { return all.begin() + static_cast<std::ptrdiff_t>(j); };
  return {at(begin), at(end)};
}

}  // namespace

Motion sites_of(const MotionOf& start, const Problem& p, std::size_t begin, std::size_t end) {
  Motion m = start(begin, end);
  const std::size_t size = end - begin;
  if (m.u.size() != size || (!m.velocity.empty() && m.velocity.size() != size))
    refuse_size(m.u.size(), std::to_string(size) + " of " + std::to_string(p.grid.sites));
  return m;
}

MotionOf pieces_of(const Motion& start, std::size_t sites) {
  return [&start, sites](std::size_t begin, std::size_t end) -> Motion {
    if (start.u.size() != sites || (!start.velocity.empty() && start.velocity.size() != sites))
      refuse_size(start.u.size(), std::to_string(sites));
    if (start.velocity.empty()) return {part(start.u, begin, end), {}};
    return {part(start.u, begin, end), part(start.velocity, begin, end)};
  };
}

void check_ranks(const Problem& p, const Ranks& ranks) {
  const Blocks blocks{p.grid.sites};
  if (static_cast<std::size_t>(ranks.size()) > blocks.count)
    throw InputError({.key = "ranks",
                      .value = std::to_string(ranks.size()),
                      .problem = "too many for " + std::to_string(p.grid.sites) + " sites",
                      .allowed = "1 to " + std::to_string(blocks.count)});
}

void StartCheck::look(const Problem& p, const Motion& m, std::size_t first) {
  for (std::size_t j = 0; j < m.u.size(); ++j) {
    if (!std::isfinite(m.u[j]) || (!m.velocity.empty() && !std::isfinite(m.velocity[j])))
      throw InputError({.key = "initial motion at x = " + digits(p.grid.x(first + j)),
                        .problem = "not a number",
                        .allowed = "finite displacement and velocity"});
    const double rise = j == 0 ? 0 : std::fabs(m.u[j] - m.u[j - 1]);
    if (rise > steepest_) {
      steepest_ = rise;
      at_ = p.grid.x(first + j);
    }
  }
}

void StartCheck::finish(const Problem& p, const Ranks& ranks) const {
  const std::vector<double> all = ranks.joined({steepest_, at_});
  double steepest = 0, at = 0;
  for (std::size_t r = 0; r < all.size(); r += 2) {
    if (!(all[r] > steepest)) continue;
    steepest = all[r];
    at = all[r + 1];
  }
  // A dislocation in a train has the greatest slope 2 beta, beta its inverse width.
  if (!p.substrate || p.model != Model::sine_gordon || !(steepest > 2 / least_sites_per_width)) return;
  ranks.together([&] {
    throw InputError(
        {.key = "spacing",
         .value = digits(p.grid.spacing),
         .problem = "too coarse: " + digits(2 / steepest) + " sites to the width of the dislocation at x = " +
                    digits(at) + ", " + digits(least_sites_per_width) + " are needed",
         .allowed = "about " + digits(p.grid.spacing * 2 / (least_sites_per_width * steepest)) + " or less"});
  });
}

void check_charge(const Problem& p, const MotionOf& start) {
  if (!p.boundary.periodic) return;
  const std::size_t n = p.grid.sites;
  const Motion first = sites_of(start, p, 0, 1), last = sites_of(start, p, n - 2, n);
  const double fits = (first.u[0] - (2 * last.u[1] - last.u[0])) / turn;
  if (std::fabs(fits - static_cast<double>(p.boundary.charge)) > 0.25)
    throw InputError({.key = "charge",
                      .value = std::to_string(p.boundary.charge),
                      .problem = "does not fit the initial state, which falls by " + digits(fits) + " turns",
                      .allowed = "the whole number of dislocations between the ends"});
}

}  // namespace slipfront::chain
