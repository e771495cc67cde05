#include "slipfront/chain/chain.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>

#include "parts.hpp"
#include "slipfront/error.hpp"
#include "start.hpp"

namespace slipfront::chain {
namespace {

constexpr double turn = 2 * std::numbers::pi;

void check_start(const Problem& p, const Motion& start) {
  const std::size_t n = p.grid.sites;
  if (start.u.size() != n || (!start.velocity.empty() && start.velocity.size() != n))
    throw InputError({.key = "initial motion",
                      .value = std::to_string(start.u.size()) + " sites",
                      .problem = "does not fit the grid",
                      .allowed = std::to_string(n) + " sites"});
  // A dislocation in a train has the greatest slope 2 beta, beta its inverse width.
  double steepest = 0, at = 0;
  for (std::size_t j = 0; j < n; ++j) {
    if (!std::isfinite(start.u[j]) || (!start.velocity.empty() && !std::isfinite(start.velocity[j])))
      throw InputError({.key = "initial motion at x = " + std::to_string(p.grid.x(j)),
                        .problem = "not a number",
                        .allowed = "finite displacement and velocity"});
    if (j == 0) continue;
    const double rise = std::fabs(start.u[j] - start.u[j - 1]);
    if (rise > steepest) {
      steepest = rise;
      at = p.grid.x(j);
    }
  }
  if (p.model == Model::sine_gordon && steepest > 2 / least_sites_per_width)
    throw InputError(
        {.key = "spacing",
         .value = std::to_string(p.grid.spacing),
         .problem = "too coarse: " + std::to_string(2 / steepest) + " sites to the width of the dislocation at x = " +
                    std::to_string(at) + ", " + std::to_string(least_sites_per_width) + " are needed",
         .allowed = "about " + std::to_string(p.grid.spacing * 2 / (least_sites_per_width * steepest)) + " or less"});
  if (p.boundary.periodic) {
    const double fits = (start.u[0] - (2 * start.u[n - 1] - start.u[n - 2])) / turn;
    if (std::fabs(fits - static_cast<double>(p.boundary.charge)) > 0.25)
      throw InputError({.key = "charge",
                        .value = std::to_string(p.boundary.charge),
                        .problem = "does not fit the initial state, which falls by " + std::to_string(fits) + " turns",
                        .allowed = "the whole number of dislocations between the ends"});
  }
}

void check_saved(const Problem& p, const Levels& saved) {
  if (saved.now.size() != p.grid.sites || saved.before.size() != p.grid.sites || saved.level < 0)
    throw InputError({.key = "resume",
                      .value = std::to_string(saved.now.size()) + " sites",
                      .problem = "does not fit the scenario",
                      .allowed = std::to_string(p.grid.sites) + " sites"});
}

}  // namespace

Chain::Chain(const Problem& problem, const Motion& start, const Execution& execution) {
  check(problem);
  check_start(problem, start);
  parts_ = std::make_unique<Parts>(problem, execution, 0);
  parts_->fill(first_levels(problem, parts_->scheme, parts_->forces, start));
}

Chain::Chain(const Problem& problem, const Levels& saved, const Execution& execution) {
  check(problem);
  check_saved(problem, saved);
  parts_ = std::make_unique<Parts>(problem, execution, saved.level);
  parts_->fill(saved);
}

Chain::~Chain() = default;
Chain::Chain(Chain&&) noexcept = default;
Chain& Chain::operator=(Chain&&) noexcept = default;

void Chain::advance(long levels) {
  while (levels > 0) {
    const long some = std::min(levels, static_cast<long>(parts_->depth));
    parts_->advance(static_cast<std::size_t>(some));
    parts_->check_numbers();
    levels -= some;
  }
}

bool Chain::advance_to(double time, const std::function<bool()>& interrupted) {
  const long target = std::lround(time / dt());
  while (level() < target) {
    advance(std::min<long>(target - level(), halo));
    if (interrupted && interrupted()) break;
  }
  return level() >= target;
}

const Problem& Chain::problem() const { return parts_->problem; }
long Chain::level() const { return parts_->level; }
double Chain::dt() const { return parts_->scheme.dt; }
double Chain::time() const { return static_cast<double>(level()) * dt(); }

Levels Chain::levels() const {
  Levels levels;
  levels.level = level();
  for (const Slab& slab : parts_->slabs) {
    levels.now.insert(levels.now.end(), slab.now(), slab.now() + slab.size());
    levels.before.insert(levels.before.end(), slab.old(), slab.old() + slab.size());
  }
  return levels;
}

double Chain::contact_squared(std::size_t site) const {
  return parts_->forces.a2() == nullptr ? 1 : parts_->forces.a2()[site];
}
double Chain::forcing(std::size_t site) const { return parts_->forces.now(site); }
double Chain::friction(double velocity) const { return parts_->forces.friction(velocity); }

}  // namespace slipfront::chain
