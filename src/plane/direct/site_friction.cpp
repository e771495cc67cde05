#include "plane/direct/site_friction.hpp"

#include <algorithm>
#include <cmath>
#include <span>

#include "plane/direct/loads.hpp"
#include "plane/direct/rows.hpp"

namespace slipfront::plane {

SiteFriction::SiteFriction(const Problem& problem, const Sites& sites, double dt)
    : problem_(problem), sites_(sites), dt_(dt) {
  if (!is_viscous() && problem.friction.acts()) friction_ = problem.friction.scaled_by(sites.scale);
  each_ = friction_.state_size();
  if (friction_.steep_at_rest()) patch_ = patch_of(problem, sites);
  states_.resize(each_ * sites.nx * sites.ny);
  for (std::size_t site = 0; each_ > 0 && site < sites.nx * sites.ny; ++site)
    friction_.start(sites.scale * sites.x(site % sites.nx), sites.scale * sites.y(site / sites.nx),
                    std::span(states_).subspan(each_ * site, each_));
}

Rubbed SiteFriction::slow(std::size_t j, bool began, const Rates& rates, const double* before, double* after) const {
  Rubbed work;
  if (problem_.edges == Edges::absorbing) work.radiated = absorb(j, before, after);
  if (is_viscous())
    work.dissipated = rub_viscous(sites_.nx, dt_, &sites_.viscous[sites_.at(0, j)], rates, before, after);
  else if (friction_.acts())
    work.dissipated = rub_by_law(j, began, before, after);
  return work;
}

/// A wave that meets an edge at a right angle leaves if the stress there is -u_t, in the unit of u_x. The site next to
/// the edge, of the width h, is slowed by u_t / h.
double SiteFriction::absorb(std::size_t j, const double* before, double* after) const {
  double work = 0;
  const auto slow_site = [&](std::size_t i, double rate) {
    after[i] = before[i] + (after[i] - before[i]) / (1 + 0.5 * dt_ * rate);
    const double velocity = (after[i] - before[i]) / (2 * dt_);
    work += rate * velocity * velocity * dt_;
  };
  const bool last_row = sites_.on_edge(static_cast<std::ptrdiff_t>(j));
  for (std::size_t i = 0; i < sites_.nx; ++i) {
    const bool last_column = i == 0 || i + 1 == sites_.nx;
    if (last_row || last_column) slow_site(i, (last_row ? 1 / sites_.hy : 0) + (last_column ? 1 / sites_.hx : 0));
    if (!last_row && i == 0) i = sites_.nx - 2;
  }
  return work;
}

double SiteFriction::rub_by_law(std::size_t j, bool began, const double* before, double* after) const {
  const std::size_t n = sites_.nx;
  std::vector<double> free(n), speed(n);
  for (std::size_t i = 0; i < n; ++i) free[i] = std::fabs(after[i] - before[i]) / (2 * dt_);
  friction_.loops().speeds_after(n, free.data(), dt_ / 2, states_of(j), speed.data());
  const char* const patch = began && !patch_.empty() ? &patch_[sites_.at(0, j)] : nullptr;
  double work = 0;
  for (std::size_t i = 0; i < n; ++i) {
    if (patch && patch[i] != 0) continue;
    const double sign = std::copysign(1.0, after[i] - before[i]);
    after[i] = before[i] + 2 * dt_ * sign * speed[i];
    work += 2 * (free[i] - speed[i]) * speed[i];  // f = (free - speed) / (dt / 2), over the time dt
  }
  return work;
}

void SiteFriction::age(std::size_t j, const double* now, const double* after) {
  if (each_ == 0) return;
  std::vector<double> speed(sites_.nx);
  for (std::size_t i = 0; i < sites_.nx; ++i) speed[i] = std::fabs(after[i] - now[i]) / dt_;
  friction_.evolution().advance_all(sites_.nx, friction::Slips::at(speed.data()), dt_, each_,
                                    states_.data() + j * sites_.nx * each_);
}

void SiteFriction::resist(std::size_t j, bool began, double* acceleration) const {
  if (!friction_.sticks()) return;
  const char* const patch = began && !patch_.empty() ? &patch_[sites_.at(0, j)] : nullptr;
  for (std::size_t i = 0; i < sites_.nx; ++i) {
    if (patch && patch[i] != 0) continue;
    const double strength = friction_.law().strength(0, states_of(j).at(i));
    acceleration[i] = std::copysign(std::fmax(std::fabs(acceleration[i]) - strength, 0), acceleration[i]);
  }
}

}  // namespace slipfront::plane
