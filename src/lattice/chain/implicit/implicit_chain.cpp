#include "lattice/chain/implicit/implicit_chain.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>

#include "friction/state/contacts.hpp"
#include "lattice/chain/model/initial_train.hpp"
#include "math/constants.hpp"
#include "math/digits.hpp"
#include "math/time_steps.hpp"
#include "slipfront/error.hpp"
#include "system/archive.hpp"
#include "system/ranks.hpp"

namespace slipfront::chain {
namespace {

void refuse(const char* key, std::string value, const char* problem, const char* allowed) {
  throw InputError({.key = key, .value = std::move(value), .problem = problem, .allowed = allowed});
}

void check_pulled_end(const Problem& p) {
  const Loading& l = p.loading;
  if (!l.acts() || l.where == Pulled::everywhere) return;
  const bool left = l.where == Pulled::left;
  if (p.boundary.periodic) refuse("periodic", "true", "a ring has no end to pull", "false");
  if ((left ? p.boundary.left : p.boundary.right) == End::fixed)
    refuse(left ? "left end" : "right end", "fixed", "the end that is pulled", "free");
}

}  // namespace

void check_implicit(const Problem& p, const Execution& execution) {
  if (execution.threads < 1) refuse("threads", std::to_string(execution.threads), "out of range", ">= 1");
  if (!p.boundary.periodic && (p.boundary.left == End::absorbing || p.boundary.right == End::absorbing))
    refuse(p.boundary.left == End::absorbing ? "left end" : "right end", "absorbing",
           "implicit steps know no absorbing ends", "free, fixed");
  if (p.friction.sticks())
    refuse("friction", std::string(p.friction.name()),
           "jumps at rest, which implicit steps, and so springs, cannot follow",
           "a law without static strength, such as rate-and-state");
  if (!p.substrate && p.friction.contacts().ageing > 0)
    refuse("contact ageing", digits(p.friction.contacts().ageing), "there is no substrate that could age",
           "0, or a contact > 0");
  check_pulled_end(p);
}

namespace {

/// (all) The motion of the sites of this rank at the start.
Motion start_of(const Problem& p, const MotionOf& start, const Execution& execution, const Ranks& ranks) {
  Motion motion;
  StartCheck look;
  ranks.together([&] {
    check(p, ranks.share_of_machine());
    check_implicit(p, execution);
    check_ranks(p, ranks);
    const OwnBlocks own(p.grid.sites, ranks);
    const std::size_t before = own.begin > 0 ? 1 : 0;  // a site more, for the slope between two ranks
    motion = sites_of(start, p, own.begin - before, own.end);
    look.look(p, motion, own.begin - before);
    for (auto* column : {&motion.u, &motion.velocity})
      if (!column->empty()) column->erase(column->begin(), column->begin() + static_cast<std::ptrdiff_t>(before));
  });
  look.finish(p, ranks);
  ranks.together([&] { check_charge(p, start); });
  return motion;
}

/// The error of a step in u, or a tenth of the slip that renews contacts if that is less.
double least_slip_of_event(const Problem& p) {
  const double renewal = p.friction.parameter("characteristic_slip");
  return renewal > 0 ? std::fmin(p.tolerance, renewal / 10) : p.tolerance;
}

ChainState first_moment(const Problem& p, Motion motion, const Ranks& ranks) {
  const OwnBlocks own(p.grid.sites, ranks);
  const std::size_t n = own.size();
  ChainState now;
  now.u = std::move(motion.u);
  now.v = motion.velocity.empty() ? std::vector<double>(n, 0.0) : std::move(motion.velocity);
  for (auto* column : {&now.w, &now.slope, &now.acceleration, &now.earlier}) column->assign(n, 0.0);
  now.flows.assign(3 * own.count, 0.0);
  now.next_step = 1e-3 * std::fmin(1, p.grid.spacing);
  now.log = EventLog(p.loading.event_velocity, least_slip_of_event(p));
  if (p.loading.fronts > 0) now.fronts = FrontLog(p.loading.event_velocity, middles_of_parts(p, p.loading.fronts));
  return now;
}

}  // namespace

ImplicitChain::ImplicitChain(const Problem& p, const MotionOf& start, const Execution& execution)
    : Chain(p, execution.ranks),
      now_(first_moment(p, start_of(p, start, execution, ranks()), ranks())),
      forces_(p, now_, ranks()),
      step_(forces_, execution.threads),
      parts_(forces_, now_) {
  for (std::size_t j = 0; j < now_.u.size(); ++j) {
    if (forces_.springs().held(j)) now_.v[j] = 0;
    now_.w[j] = now_.v[j];
    if (!forces_.rubs()) continue;
    const double v = now_.v[j], change = SiteForces::difference(v);
    now_.slope[j] = (forces_.friction(now_, j, v + change) - forces_.friction(now_, j, v)) / change;
  }
}

ImplicitChain::ImplicitChain(const Problem& p, const Motion& start, const Execution& execution)
    : ImplicitChain(p, pieces_of(start, p.grid.sites), execution) {}

SpringEnergy ImplicitChain::spring_energy() const {
  const double pulled = forces_.loading_energy(now_), of_end = forces_.share_of_end() * pulled;
  return {forces_.springs().energy(now_.u) + of_end, pulled - of_end};
}

Flows ImplicitChain::flows() const {
  const std::vector<double> all = ranks().joined(now_.flows);
  Flows flows;
  for (std::size_t i = 0; i < all.size(); i += 3) {
    flows.supplied += all[i];
    flows.dissipated += all[i + 1];
    flows.by_contacts += all[i + 2];
  }
  return flows;
}

/// A site of this rank, counted from its first one on, or a site of the rank next to it.
ImplicitChain::Shown ImplicitChain::shown(long site) const {
  const long n = static_cast<long>(now_.u.size());
  if (site < 0 || site >= n) {
    const Halo& of = site < 0 ? before_own_ : after_own_;
    const std::size_t at = 4 * static_cast<std::size_t>(site < 0 ? site + static_cast<long>(halo) : site - n);
    return {of[at], of[at + 1], of[at + 2], of[at + 3]};
  }
  const auto j = static_cast<std::size_t>(site);
  return {now_.u[j], now_.v[j], forces_.contact_squared(now_, j), forces_.effective_stress(now_, j)};
}

void ImplicitChain::exchange() const {
  const auto from = [this](std::size_t begin) {
    Halo sites;
    for (std::size_t i = 0; i < halo; ++i) {
      const Shown site = shown(static_cast<long>(begin + i));
      const std::array<double, 4> numbers{site.u, site.velocity, site.contact_squared, site.effective_stress};
      std::copy(numbers.begin(), numbers.end(), sites.begin() + static_cast<std::ptrdiff_t>(4 * i));
    }
    return sites;
  };
  const Halo first = from(0), last = from(now_.u.size() - halo);
  ranks().exchange(first, last, before_own_, after_own_, problem().boundary.periodic);
}

/// u of a site, also past the ends of the chain.
double ImplicitChain::displacement(long site) const {
  const CompactSprings& springs = forces_.springs();
  const long n = static_cast<long>(now_.u.size()), last = site < 0 ? 0 : n - 1;
  if (site >= 0 && site < n) return now_.u[static_cast<std::size_t>(site)];
  const auto end = static_cast<std::size_t>(last);
  if (site < 0 ? springs.at_left_end(end) : springs.at_right_end(end)) {
    const double mirrored = shown(2 * last - site).u;
    return springs.held(end) ? 2 * now_.u[end] - mirrored : mirrored;
  }
  const double u = shown(site).u, charge = turn * static_cast<double>(problem().boundary.charge);
  if (site < 0 && forces_.own().begin == 0) return u + charge;
  return site >= n && forces_.own().end == problem().grid.sites ? u - charge : u;
}

Window ImplicitChain::own_window(std::size_t from, std::size_t to, double) const {
  const double h = problem().grid.spacing;
  const auto u = [&](long j) { return displacement(j); };
  Window window;
  window.begin = from;
  for (std::size_t i = from; i < to; ++i) {
    const long j = static_cast<long>(i) - static_cast<long>(forces_.own().begin);
    const Shown site = shown(j);
    window.x.push_back(problem().grid.x(i));
    window.u.push_back(site.u);
    window.velocity.push_back(site.velocity);
    window.contact_squared.push_back(site.contact_squared);
    window.effective_stress.push_back(site.effective_stress);
    window.stress.push_back(problem().model == Model::lattice
                                ? (u(j - 1) - u(j + 1)) / (2 * h)
                                : (45 * (u(j - 1) - u(j + 1)) - 9 * (u(j - 2) - u(j + 2)) + u(j - 3) - u(j + 3)) /
                                      (60 * h));
  }
  return window;
}

/// (all) Hands the step to the record of fronts.
void ImplicitChain::look_at_fronts() {
  const OwnBlocks& sites = forces_.own();
  const auto means = [&](const auto& value) { return sites.means(ranks(), problem().loading.fronts, value); };
  const auto ahead = [&] {
    exchange();
    const Window window = own_window(sites.begin, sites.end, now_.time);
    return Tractions{means([&](std::size_t j) { return window.stress[j]; }), means([&](std::size_t j) {
                       return forces_.friction(now_, j, now_.w[j]) +
                              forces_.contact_squared(now_, j) * std::sin(now_.u[j]);
                     })};
  };
  const double direction = problem().loading.velocity < 0 ? -1 : 1;
  const auto velocity = [&](std::size_t j) { return direction * now_.w[j]; };
  now_.fronts.look(now_.time, means(velocity), now_.log, ahead);
}

/// (all)
void ImplicitChain::fail(const std::string& why) const {
  ranks().together([&] { throw NumericsError("t = " + digits(now_.time) + ": " + why); });
}

void ImplicitChain::give_up() const {
  fail("no implicit step is short enough; the motion at x = " + digits(step_.hardest_position()) +
       " cannot be followed");
}

/// Ends a run that no longer makes progress: 10,000 implicit steps advanced it by less than one explicit step would.
void ImplicitChain::check_progress() {
  constexpr long window = 10000;
  if (now_.steps % window != 0) return;
  const double advanced = now_.time - now_.window_start, explicit_step = chosen_step(problem());
  now_.window_start = now_.time;
  if (advanced > explicit_step) return;
  fail("the last " + std::to_string(window) + " implicit steps advanced the chain by " + digits(advanced, 2) +
       " only; an explicit step is " + digits(explicit_step, 2) + ". Try a larger tolerance, or check for " +
       "forces that change faster than the chain can move");
}

void ImplicitChain::finish_step() {
  if (forces_.contacts_change()) ranks().together([this] { forces_.check_contacts(now_); });
  if (!now_.log.active()) return;
  parts_.look(now_);
  if (now_.fronts.active()) look_at_fronts();
}

/// One step, as long as its error allows.
void ImplicitChain::step() {
  constexpr StepControl control{.order = 3, .most_growth = 2, .least_reduction = 0.8, .failure_factor = 0.2};
  const double shortest = 1e-9 * std::fmax(1, problem().grid.spacing);
  const StepTaken taken = take_step(
      control, now_.next_step,
      [this](double dt) {
        const bool solved = step_.solve(now_, dt);
        return StepAttempt{.succeeded = solved, .error = solved ? step_.error(now_, dt) : 0};
      },
      [this, shortest](double dt, int) {
        if (dt < shortest) give_up();
        return false;
      });
  now_.next_step = taken.next;
  step_.take(now_, taken.length);
  now_.time += taken.length;
  check_progress();
  finish_step();
}

/// The motion at a time that lies inside a step which has been taken: shorter steps from its start, whose errors are
/// smaller.
void ImplicitChain::step_to(double time) {
  constexpr double shortest = 1e-12;
  while (now_.time < time) {
    const double remaining = time - now_.time;
    double dt = remaining;
    while (!step_.solve(now_, dt)) {
      dt /= 2;
      if (dt < shortest * remaining) give_up();
    }
    step_.take(now_, dt);
    now_.time = dt == remaining ? time : now_.time + dt;
  }
  finish_step();
}

bool ImplicitChain::advance_to(double until, long most) {
  for (; most > 0 && now_.time < until; --most) {
    if (passed_ && after_.time <= until) {
      std::swap(now_, after_);
      passed_ = false;
      continue;
    }
    if (!passed_) {
      const bool may_pass = now_.time + now_.next_step > until;
      if (may_pass) before_ = now_;
      step();
      if (now_.time <= until) continue;
      std::swap(now_, after_);
      passed_ = true;
    }
    now_ = before_;
    step_to(until);
  }
  return reached(until);
}

void ImplicitChain::archive(Archive& a) {
  double shown_time = now_.time;
  a.same(problem().grid.sites);
  a(shown_time);
  a.require(std::isfinite(shown_time));
  if (!a.reads()) return (passed_ ? before_ : now_).archive(a, forces_.own(), ranks());
  ranks().together([&] {
    ChainState saved = now_;
    saved.archive(a, forces_.own(), ranks());
    forces_.strengthen_contacts(saved);
    now_ = std::move(saved);
  });
  passed_ = false;
  advance_to(shown_time);
}

namespace {

constexpr std::size_t sums = 3;

std::size_t count_of_parts(const Problem& p, const std::vector<double>& ends) {
  const double turns = std::fabs(ends.front() - ends.back()) / (2 * std::numbers::pi);
  const double dislocations = std::max(turns, std::fabs(static_cast<double>(p.boundary.charge)));
  const double length = static_cast<double>(p.grid.sites) * p.grid.spacing;
  const double wanted = !p.substrate        ? static_cast<double>(p.grid.sites) / 8
                        : dislocations >= 8 ? dislocations / 8
                                            : length / 60;
  return static_cast<std::size_t>(std::clamp(wanted, 1.0, 64.0));
}

/// The mean stiffness of the springs of each part.
std::vector<double> stiffness_of_parts(const Problem& p, std::size_t count) {
  std::vector<double> means(count, p.loading.stiffness);
  if (!p.loading.stiffness_at) return means;
  const Blocks blocks{p.grid.sites};
  for (std::size_t i = 0; i < count; ++i) {
    double sum = 0;
    const std::size_t begin = blocks.part_begin(i, count), end = blocks.part_begin(i + 1, count);
    for (std::size_t j = begin; j < end; ++j) sum += p.loading.stiffness_at(p.grid.x(j));
    means[i] = sum / static_cast<double>(end - begin);
  }
  return means;
}

}  // namespace

std::vector<double> middles_of_parts(const Problem& p, std::size_t count) {
  const Blocks blocks{p.grid.sites};
  std::vector<double> x;
  for (std::size_t i = 0; i < count; ++i)
    x.push_back((p.grid.x(blocks.part_begin(i, count)) + p.grid.x(blocks.part_begin(i + 1, count) - 1)) / 2);
  return x;
}

WatchedParts::WatchedParts(const SiteForces& forces, const ChainState& now)
    : forces_(forces), direction_(forces.problem().loading.velocity < 0 ? -1 : 1), first_(0) {
  const Problem& p = forces.problem();
  const OwnBlocks& own = forces.own();
  const std::size_t count = count_of_parts(p, forces.ranks().joined({now.u.front(), now.u.back()}));
  const std::size_t intervals = p.boundary.periodic ? p.grid.sites : p.grid.sites - 1;
  parts_.length = static_cast<double>(intervals) * p.grid.spacing / static_cast<double>(count);
  parts_.ring = p.boundary.periodic;
  if (p.loading.where == Pulled::everywhere) parts_.stiffness = stiffness_of_parts(p, count);
  for (auto* column : {&parts_.u, &parts_.velocity}) column->resize(count);
  parts_.x = middles_of_parts(p, count);
  own.blocks.each_piece(count, [&](std::size_t part, std::size_t begin, std::size_t end) {
    if (begin < own.begin) ++first_;
    if (begin >= own.begin && begin < own.end) ++count_;
    pieces_.push_back({part, begin, end});
  });
  mine_.resize(sums * count_);
  all_.resize(sums * pieces_.size());
}

void WatchedParts::add_up(const ChainState& m) {
  const CompactSprings& springs = forces_.springs();
  const Pulled where = forces_.problem().loading.where;
  const std::size_t offset = forces_.own().begin;
  for (std::size_t i = 0; i < count_; ++i) {
    const Piece& piece = pieces_[first_ + i];
    double u = 0, w = 0, load = 0;
    for (std::size_t j = piece.begin - offset; j < piece.end - offset; ++j) {
      u += direction_ * m.u[j];
      w += direction_ * m.w[j];
      if (where == Pulled::everywhere || forces_.pull(j) > 0) load += springs.weight(j) * forces_.forcing(m, j);
    }
    double* const to = &mine_[sums * i];
    to[0] = u;
    to[1] = w;
    to[2] = load;
  }
  forces_.ranks().join(mine_, all_);
}

double WatchedParts::load_by_sums() const {
  const Problem& p = forces_.problem();
  if (!p.loading.acts()) return 0;
  double load = 0;
  for (std::size_t i = 0; i < pieces_.size(); ++i) load += all_[sums * i + 2];
  if (p.loading.where != Pulled::everywhere) return load;
  return load / (p.grid.spacing * static_cast<double>(p.boundary.periodic ? p.grid.sites : p.grid.sites - 1));
}

double WatchedParts::load(const ChainState& m) {
  if (!forces_.problem().loading.acts()) return 0;
  add_up(m);
  return load_by_sums();
}

void WatchedParts::look(ChainState& m) {
  add_up(m);
  std::fill(parts_.u.begin(), parts_.u.end(), 0.0);
  std::fill(parts_.velocity.begin(), parts_.velocity.end(), 0.0);
  for (std::size_t i = 0; i < pieces_.size(); ++i) {
    parts_.u[pieces_[i].part] += all_[sums * i];
    parts_.velocity[pieces_[i].part] += all_[sums * i + 1];
  }
  const std::size_t count = parts_.x.size();
  for (std::size_t i = 0; i < count; ++i) {
    const auto sites = static_cast<double>(forces_.own().blocks.part_size(i, count));
    parts_.u[i] /= sites;
    parts_.velocity[i] /= sites;
  }
  m.log.look(m.time, direction_ * load_by_sums(), parts_);
}

}  // namespace slipfront::chain
