#include "slipfront/chain/chain.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>

#include "forces.hpp"
#include "scheme.hpp"
#include "slab.hpp"
#include "slipfront/error.hpp"
#include "start.hpp"

namespace slipfront::chain {
namespace {

constexpr double turn = 2 * std::numbers::pi;

Sides sides_of(const Problem& p, const Scheme& s) {
  const auto side = [](End end) {
    return end == End::free ? Side::free : end == End::fixed ? Side::fixed : Side::absorbing;
  };
  Sides sides{side(p.boundary.left), side(p.boundary.right), 0, s.dt / s.h};
  if (p.boundary.periodic) sides = {Side::seam, Side::seam, static_cast<double>(p.boundary.charge), 1};
  return sides;
}

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

struct Chain::Parts {
  Problem problem;
  Scheme scheme;
  Sides sides;
  Execution execution;
  Forces forces;
  std::vector<Slab> slabs;
  long level = 0;
  std::size_t depth = halo;  ///< levels between exchanges

  Parts(const Problem& p, const Execution& e, long at)
      : problem(p), scheme(scheme_of(p)), sides(sides_of(p, scheme)), execution(e), forces(p, scheme, at), level(at) {
    if (e.threads < 1)
      throw InputError(
          {.key = "threads", .value = std::to_string(e.threads), .problem = "out of range", .allowed = ">= 1"});
    const std::size_t n = p.grid.sites;
    const std::size_t count = std::clamp<std::size_t>(n / (2 * halo), 1, static_cast<std::size_t>(e.threads));
    execution.tile = std::max(e.tile / lanes * lanes, 2 * halo);
    for (std::size_t i = 0; i < count; ++i) {
      const std::size_t begin = n * i / count, end = n * (i + 1) / count;
      Sides s = sides;
      if (i > 0) s.left = Side::joined;
      if (i + 1 < count) s.right = Side::joined;
      slabs.emplace_back(begin, end - begin, s);
    }
    depth = forces.none() ? std::min(halo, n) : 1;
  }

  void fill(const Levels& levels) {
    for (Slab& slab : slabs) {
      std::copy_n(levels.now.data() + slab.begin(), slab.size(), slab.now());
      std::copy_n(levels.before.data() + slab.begin(), slab.size(), slab.old());
    }
  }

  /// Halos of slab i from its neighbours, around a periodic chain too; across its seam the values are left as they are.
  /// Where a chain is cut over processes this is the place of the messages.
  void exchange(std::size_t i) {
    Slab& slab = slabs[i];
    const std::size_t count = slabs.size(), most = std::min(halo, problem.grid.sites);
    if (slab.sides().left == Side::joined || slab.sides().left == Side::seam) {
      const Slab& from = slabs[(i + count - 1) % count];
      std::copy_n(from.now() + from.size() - most, most, slab.now() - most);
      std::copy_n(from.old() + from.size() - most, most, slab.old() - most);
    }
    if (slab.sides().right == Side::joined || slab.sides().right == Side::seam) {
      const Slab& from = slabs[(i + 1) % count];
      std::copy_n(from.now(), most, slab.now() + slab.size());
      std::copy_n(from.old(), most, slab.old() + slab.size());
    }
  }

  void advance_slab(Slab& slab, std::size_t count) {
    if (forces.none()) {
      slab.advance(scheme.rule, count, execution.tile);
      return;
    }
    constexpr std::size_t pad = lanes;
    Aligned y(slab.size() + 4 * pad), before(slab.size());
    forces.level(slab.sides(), static_cast<long>(slab.begin()), slab.size(), slab.now(), slab.old(), y.data() + pad,
                 before.data());
    slab.swap();
  }

  void advance(std::size_t count) {
    const int number = static_cast<int>(slabs.size());
    // Fewer site updates than this take less time than it takes to wake a thread.
    const bool worth = problem.grid.sites * count > 50000;
    static_cast<void>(worth);  // where there is no OpenMP
#ifdef _OPENMP
#pragma omp parallel for num_threads(number) schedule(static, 1) if (worth)
#endif
    for (int i = 0; i < number; ++i) exchange(static_cast<std::size_t>(i));
#ifdef _OPENMP
#pragma omp parallel for num_threads(number) schedule(static, 1) if (worth)
#endif
    for (int i = 0; i < number; ++i) advance_slab(slabs[static_cast<std::size_t>(i)], count);
    level += static_cast<long>(count);
    if (!forces.none()) forces.proceed();
  }

  void check_numbers() const {
    for (const Slab& slab : slabs) {
      if (bounded(slab.now(), slab.size())) continue;
      std::size_t j = 0;
      while (bounded(slab.now() + j, 1)) ++j;
      const std::size_t site = slab.begin() + j;
      throw NumericsError("t = " + std::to_string(static_cast<double>(level) * scheme.dt) + ": displacement of site " +
                          std::to_string(site) + " (x = " + std::to_string(problem.grid.x(site)) + ") is not a number");
    }
  }

  /// z / 2 pi of site j at both levels, also beyond the ends.
  std::pair<double, double> site(long j) const {
    const long n = static_cast<long>(problem.grid.sites);
    double now_shift = 0, old_shift = 0, sign = 1;
    const auto reflect = [&](long end, End kind) {
      j = 2 * end - j;
      if (kind != End::fixed) return;
      const auto [now, old] = site(end);
      sign = -1;
      now_shift = 2 * now;
      old_shift = 2 * old;
    };
    if (problem.boundary.periodic) {
      const long around = j < 0 ? -1 : j >= n ? 1 : 0;
      j -= around * n;
      now_shift = old_shift = -static_cast<double>(around * problem.boundary.charge);
    } else if (j < 0) {
      reflect(0, problem.boundary.left);
    } else if (j >= n) {
      reflect(n - 1, problem.boundary.right);
    }
    const auto at = static_cast<std::size_t>(j);
    std::size_t i = std::min(at * slabs.size() / problem.grid.sites, slabs.size() - 1);
    while (at < slabs[i].begin()) --i;
    while (at >= slabs[i].begin() + slabs[i].size()) ++i;
    const std::size_t k = at - slabs[i].begin();
    return {sign * slabs[i].now()[k] + now_shift, sign * slabs[i].old()[k] + old_shift};
  }
};

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

Window Chain::window(std::size_t begin, std::size_t end, double time) const {
  const Parts& parts = *parts_;
  const Scheme& s = parts.scheme;
  const double dt = s.dt, h = s.h, tau = time - this->time();
  const long n = static_cast<long>(parts.problem.grid.sites);
  if (!(begin < end) || end > parts.problem.grid.sites || !(std::fabs(tau) <= 1.0001 * dt))
    throw InputError(
        {.key = "window", .problem = "outside the chain or its present step", .allowed = "sites of the chain, now"});
  // Three levels of z and u with five sites beyond; the next level is computed and thrown away.
  constexpr long reach = 5;
  const std::size_t size = end - begin, wide = size + 2 * reach, room = wide + 4 * lanes;
  const long low = static_cast<long>(begin) - reach;
  std::vector<double> z(room), old(room), next(room), y(room), work(room);
  for (std::size_t j = 0; j < wide; ++j) {
    const auto [a, b] = parts.site(low + static_cast<long>(j));
    z[j + lanes] = a;
    old[j + lanes] = b;
  }
  next = old;
  constexpr std::size_t edge = lanes + 2;  // two sites in, neighbours are there
  parts.forces.level({}, low + 2, wide - 4, z.data() + edge, next.data() + edge, y.data() + edge, work.data());
  if (!parts.problem.boundary.periodic) {  // the ends by their own rule
    const auto at = [&](long j) { return static_cast<std::size_t>(j - low) + lanes; };
    const double courant = parts.sides.courant;
    if (begin == 0 && parts.sides.left == Side::absorbing) next[at(0)] = z[at(0)] + courant * (z[at(1)] - z[at(0)]);
    if (static_cast<long>(end) == n && parts.sides.right == Side::absorbing)
      next[at(n - 1)] = z[at(n - 1)] + courant * (z[at(n - 2)] - z[at(n - 1)]);
  }
  std::vector<double> a2;
  if (parts.forces.a2() != nullptr)
    a2.assign(parts.forces.a2() + low, parts.forces.a2() + low + static_cast<long>(wide));
  std::vector<double> u_old(wide), u_now(wide), u_next(wide), S_old(wide), S_now(wide), S_next(wide);
  const PeriodicForce sine = substrate_force(0);
  const double* contact = a2.empty() ? nullptr : a2.data();
  displacements(sine, s.eps, contact, old.data() + lanes, u_old.data(), S_old.data(), wide);
  displacements(sine, s.eps, contact, z.data() + lanes, u_now.data(), S_now.data(), wide);
  displacements(sine, s.eps, contact, next.data() + lanes, u_next.data(), S_next.data(), wide);

  const double C =
      parts.problem.friction.law == modulation::FrictionLaw::viscous ? parts.problem.friction.coefficient : 0;
  const auto rate = [&](std::size_t j) { return (u_next[j] - u_old[j]) / (2 * dt); };
  Window window;
  window.begin = begin;
  for (std::size_t j = reach; j < reach + size; ++j) {
    const std::size_t site = begin + j - reach;
    const double acceleration = (u_next[j] - 2 * u_now[j] + u_old[j]) / (dt * dt);
    // u_ttt from the equation of motion: what the central difference needs to be of fourth order.
    const double jerk = (rate(j + 1) - 2 * rate(j) + rate(j - 1)) / (h * h) - (S_next[j] - S_old[j]) / (2 * dt) -
                        C * acceleration + parts.forces.rate(site) / turn;
    const double velocity = rate(j) - dt * dt / 6 * jerk;
    const auto stress = [&](const std::vector<double>& u) {
      if (parts.problem.model == Model::lattice) return (u[j - 1] - u[j + 1]) / (2 * h);
      return (45 * (u[j - 1] - u[j + 1]) - 9 * (u[j - 2] - u[j + 2]) + (u[j - 3] - u[j + 3])) / (60 * h);
    };
    const double stress_rate = (stress(u_next) - stress(u_old)) / (2 * dt);
    window.x.push_back(parts.problem.grid.x(site));
    window.u.push_back(turn * (u_now[j] + tau * (velocity + tau / 2 * (acceleration + tau / 3 * jerk))));
    window.velocity.push_back(turn * (velocity + tau * (acceleration + tau / 2 * jerk)));
    window.stress.push_back(turn * (stress(u_now) + tau * stress_rate));
  }
  return window;
}

}  // namespace slipfront::chain
