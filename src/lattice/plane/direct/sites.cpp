#include "lattice/plane/direct/sites.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <span>

#include "lattice/plane/direct/rows.hpp"
#include "math/digits.hpp"
#include "slipfront/error.hpp"

namespace slipfront::plane {

std::vector<char> patch_of(const Problem& p, const Sites& sites) {
  if (!p.nucleation) return {};
  std::vector<char> patch(sites.size(), 0);
  const Nucleation& n = *p.nucleation;
  sites.for_each_in_reach(
      [&](std::size_t at, double x, double y) { patch[at] = std::hypot(x - n.x, y - n.y) <= n.radius ? 1 : 0; });
  return patch;
}

Loads::Loads(const Problem& problem, const Sites& sites)
    : problem_(problem), sites_(sites), patch_(patch_of(problem, sites)) {}

void Loads::hold(const std::vector<double>& acceleration) {
  held_.assign(sites_.size(), 0);
  for (std::size_t i = 0; i < held_.size(); ++i) held_[i] = -acceleration[i];
  is_known_ = false;
}

void Loads::find(double time) {
  const bool released = problem_.nucleation_has_begun(time);
  if (is_known_ && released == released_ && !problem_.forcing) return;
  is_known_ = true;
  released_ = released;
  force_ = held_;
  if (!force_.empty() && released)
    for (std::size_t at = 0; at < force_.size(); ++at)
      if (patch_[at] != 0) force_[at] = 0;
  if (!problem_.forcing) return;
  force_.resize(sites_.size());
  sites_.for_each_in_reach(
      [&](std::size_t at, double x, double y) { force_[at] += problem_.forcing(x, y, time) / sites_.scale; });
}

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

FrictionWork SiteFriction::slow(std::size_t j, bool began, const Rates& rates, const double* before,
                                double* after) const {
  FrictionWork work;
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

namespace {

constexpr double most_sites = 1e10;

InputError refusal(const char* key, double value, const char* problem, const char* allowed) {
  return InputError({.key = key, .value = digits(value), .problem = problem, .allowed = allowed});
}

/// The largest contact ratio on a grid of samples.
double largest_contact(const Problem& p) {
  if (!p.contact) return 1;
  constexpr int samples = 200;
  double largest = 0;
  for (int j = 0; j <= samples; ++j)
    for (int i = 0; i <= samples; ++i)
      largest = std::fmax(
          largest, p.contact(p.left + (p.right - p.left) * i / samples, p.bottom + (p.top - p.bottom) * j / samples));
  return largest;
}

template <class Value>
std::vector<double> at_each(const Sites& sites, const Value& value) {
  std::vector<double> all(sites.size(), 0.0);
  sites.for_each_in_reach([&](std::size_t at, double x, double y) { all[at] = value(x, y); });
  return all;
}

void fix_edges(Sites& sites) {
  if (sites.moves.empty()) sites.moves = at_each(sites, [](double, double) { return 1.0; });
  const auto ghosts = static_cast<std::ptrdiff_t>(Sites::ghost_rows), rows = static_cast<std::ptrdiff_t>(sites.ny);
  for (std::ptrdiff_t row = -ghosts; row < rows + ghosts; ++row) {
    double* const moves = &sites.moves[sites.start_of(row)];
    if (sites.on_edge(row)) std::fill_n(moves, sites.nx, 0.0);
    moves[0] = moves[sites.nx - 1] = 0;
  }
}

/// Finds what acts on each site.
void fill(const Problem& p, Sites& sites) {
  if (p.contact)
    sites.contact2 = at_each(sites, [&](double x, double y) {
      const double a = p.contact(x, y);
      return a * a;
    });
  if (p.friction.is_viscous())
    sites.viscous =
        at_each(sites, [&](double x, double y) { return *p.friction.linear_coefficient(x, y) / sites.scale; });
  if (p.fixed) sites.moves = at_each(sites, [&](double x, double y) { return p.fixed(x, y) == 0 ? 1.0 : 0.0; });
  if (p.edges == Edges::fixed) fix_edges(sites);
}

/// The first row of a band.
std::size_t first_of(int number, int bands, std::size_t rows) {
  return rows * static_cast<std::size_t>(number) / static_cast<std::size_t>(bands);
}

}  // namespace

Counts count_sites(const Problem& p, double scale, double spacing) {
  assert(scale > 0 && std::isfinite(scale));
  if (!(spacing > 0 && spacing <= 0.5)) throw refusal("spacing", spacing, "out of range", "> 0 and <= 0.5");
  const double widest = spacing / largest_contact(p);
  const Counts n{std::ceil((p.right - p.left) * scale / widest), std::ceil((p.top - p.bottom) * scale / widest)};
  if (!(n.nx >= 4 && n.ny >= 4)) throw refusal("scale", scale, "fewer than 4 x 4 sites", "a larger scale");
  if (!(n.nx * n.ny <= most_sites)) throw refusal("scale", scale, "more than ten billion sites", "a smaller scale");
  return n;
}

Sites make_sites(const Problem& p, double scale, double spacing, Band band) {
  const auto [nx, ny] = count_sites(p, scale, spacing);
  Sites sites;
  sites.nx = static_cast<std::size_t>(nx);
  sites.all_rows = static_cast<std::size_t>(ny);
  if (!(sites.all_rows >= Sites::ghost_rows * static_cast<std::size_t>(band.bands)))
    throw refusal("ranks", band.bands, "too many for so few rows of sites", "a rank for each four rows, or fewer");
  sites.first_row = first_of(band.number, band.bands, sites.all_rows);
  sites.ny = first_of(band.number + 1, band.bands, sites.all_rows) - sites.first_row;
  sites.scale = scale;
  sites.left = p.left;
  sites.bottom = p.bottom;
  sites.hx = (p.right - p.left) * scale / nx;
  sites.hy = (p.top - p.bottom) * scale / ny;
  fill(p, sites);
  return sites;
}

Sites widened(const Problem& p, const Sites& sites, std::size_t rows) {
  Sites wide = sites;
  wide.first_row -= std::min(rows, sites.first_row);
  wide.ny = std::min(sites.first_row + sites.ny + rows, sites.all_rows) - wide.first_row;
  fill(p, wide);
  return wide;
}

}  // namespace slipfront::plane
