#include "chain/implicit/implicit_chain.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <type_traits>
#include <utility>

#include "chain/implicit/check_implicit.hpp"
#include "chain/model/start_check.hpp"
#include "foundation/bytes.hpp"
#include "foundation/math/step_control.hpp"
#include "foundation/ranks.hpp"
#include "foundation/text/digits.hpp"
#include "slipfront/error.hpp"

namespace slipfront::chain {
namespace {

constexpr double turn = 2 * std::numbers::pi;

/// The sites [from, to) whose mean is taken at position i of the record of fronts.
std::pair<std::size_t, std::size_t> sites_at(const Problem& p, std::size_t i) {
  return {p.grid.sites * i / p.loading.fronts, p.grid.sites * (i + 1) / p.loading.fronts};
}

std::vector<double> positions_of(const Problem& p) {
  std::vector<double> x;
  for (std::size_t i = 0; i < p.loading.fronts; ++i) {
    const auto [from, to] = sites_at(p, i);
    x.push_back((p.grid.x(from) + p.grid.x(to - 1)) / 2);
  }
  return x;
}

Moment first_moment(const Problem& p, const MotionOf& start, const Execution& execution) {
  check(p);
  check_implicit(p, execution);
  const std::size_t n = p.grid.sites;
  Motion motion = sites_of(start, p, 0, n);
  StartCheck look;
  look.look(p, motion, 0);
  look.finish(p, Ranks{});
  check_charge(p, start);
  Moment now;
  now.u = std::move(motion.u);
  now.v = motion.velocity.empty() ? std::vector<double>(n, 0.0) : std::move(motion.velocity);
  for (auto* column : {&now.w, &now.slope, &now.acceleration, &now.earlier}) column->assign(n, 0.0);
  now.next_step = 1e-3 * std::fmin(1, p.grid.spacing);
  now.log = EventLog(p.loading.event_velocity);
  if (p.loading.fronts > 0) now.fronts = FrontLog(p.loading.event_velocity, positions_of(p));
  return now;
}

/// Parts with eight dislocations or more each, or 60 widths of one long. A smooth surface has no dislocations, and its
/// parts have eight sites or more.
ChainParts parts_of(const Problem& p, const std::vector<double>& u) {
  const double dislocations =
      std::max(std::fabs(u.front() - u.back()) / turn, std::fabs(static_cast<double>(p.boundary.charge)));
  const double length = static_cast<double>(p.grid.sites) * p.grid.spacing;
  const double parts_wanted = !p.substrate        ? static_cast<double>(p.grid.sites) / 8
                              : dislocations >= 8 ? dislocations / 8
                                                  : length / 60;
  const auto count = static_cast<std::size_t>(std::clamp(parts_wanted, 1.0, 64.0));
  ChainParts parts;
  parts.length = length / static_cast<double>(count);
  parts.ring = p.boundary.periodic;
  for (auto* column : {&parts.x, &parts.u, &parts.velocity}) column->resize(count);
  return parts;
}

/// u of a moment, also past the ends of the chain.
double displacement_at(const Problem& p, const CompactSprings& springs, const std::vector<double>& u, long j) {
  const long n = static_cast<long>(u.size());
  const auto site = [&](long i) { return u[static_cast<std::size_t>(std::clamp(i, 0L, n - 1))]; };
  if (j >= 0 && j < n) return site(j);
  const double charge = turn * static_cast<double>(p.boundary.charge);
  if (p.boundary.periodic) return j < 0 ? site(j + n) + charge : site(j - n) - charge;
  const long last = j < 0 ? 0 : n - 1;
  const double mirrored = site(2 * last - j);
  return springs.held(static_cast<std::size_t>(last)) ? 2 * site(last) - mirrored : mirrored;
}

}  // namespace

ImplicitChain::ImplicitChain(const Problem& p, const MotionOf& start, const Execution& execution)
    : Chain(p, nullptr),
      now_(first_moment(p, start, execution)),
      forces_(p, now_),
      step_(forces_, execution.threads),
      parts_(parts_of(p, now_.u)) {
  for (std::size_t j = 0; j < now_.u.size(); ++j) {
    if (forces_.springs().held(j)) now_.v[j] = 0;
    now_.w[j] = now_.v[j];
    if (!forces_.rubs()) continue;
    const double v = now_.v[j], change = SiteForces::difference(v);
    now_.slope[j] = (friction(j, v + change) - friction(j, v)) / change;
  }
}

ImplicitChain::ImplicitChain(const Problem& p, const Motion& start, const Execution& execution)
    : ImplicitChain(p, pieces_of(start, p.grid.sites), execution) {}

SpringEnergy ImplicitChain::spring_energy() const {
  return {forces_.springs().energy(now_.u), forces_.loading_energy(now_)};
}

Window ImplicitChain::own_window(std::size_t from, std::size_t to, double) const {
  const double h = problem().grid.spacing;
  const auto u = [&](long j) { return displacement_at(problem(), forces_.springs(), now_.u, j); };
  Window window;
  window.begin = from;
  for (std::size_t i = from; i < to; ++i) {
    const long j = static_cast<long>(i);
    window.x.push_back(problem().grid.x(i));
    window.u.push_back(now_.u[i]);
    window.velocity.push_back(now_.v[i]);
    window.contact_squared.push_back(forces_.contact_squared(now_, i));
    window.effective_stress.push_back(forces_.effective_stress(now_, i));
    window.stress.push_back(problem().model == Model::lattice
                                ? (u(j - 1) - u(j + 1)) / (2 * h)
                                : (45 * (u(j - 1) - u(j + 1)) - 9 * (u(j - 2) - u(j + 2)) + u(j - 3) - u(j + 3)) /
                                      (60 * h));
  }
  return window;
}

double ImplicitChain::load() const {
  if (!problem().loading.acts()) return 0;
  const bool everywhere = problem().loading.where == Pulled::everywhere;
  const std::size_t n = now_.u.size();
  double load = 0;
  for (std::size_t j = 0; j < n; ++j)
    if (everywhere || forces_.pull(j) > 0) load += forces_.springs().weight(j) * forcing(j);
  return everywhere ? load / (problem().grid.spacing * static_cast<double>(problem().boundary.periodic ? n : n - 1))
                    : load;
}

/// Hands the step that has just been taken to the log of events. Slip counts as positive in the direction of the
/// springs.
void ImplicitChain::look() {
  const Loading& loading = problem().loading;
  const double direction = loading.velocity < 0 ? -1 : 1;
  const std::size_t n = now_.u.size(), count = parts_.x.size();
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t from = n * i / count, to = n * (i + 1) / count;
    double u = 0, p = 0;
    for (std::size_t j = from; j < to; ++j) {
      u += direction * now_.u[j];
      p += forces_.springs().held(j) ? 0 : direction * now_.w[j];
    }
    const double sites = static_cast<double>(to - from);
    parts_.x[i] = (problem().grid.x(from) + problem().grid.x(to - 1)) / 2;
    parts_.u[i] = u / sites;
    parts_.velocity[i] = p / sites;
  }
  now_.log.look(now_.time, direction * load(), parts_);
  if (now_.fronts.active()) look_at_fronts(direction);
}

/// Hands the step to the record of fronts.
void ImplicitChain::look_at_fronts(double direction) {
  const auto means = [this](const auto& value) {
    std::vector<double> all;
    for (std::size_t i = 0; i < problem().loading.fronts; ++i) {
      const auto [from, to] = sites_at(problem(), i);
      double sum = 0;
      for (std::size_t j = from; j < to; ++j) sum += value(j);
      all.push_back(sum / static_cast<double>(to - from));
    }
    return all;
  };
  const auto ahead = [&] {
    const Window window = own_window(0, now_.u.size(), now_.time);
    return Tractions{means([&](std::size_t j) { return window.stress[j]; }), means([&](std::size_t j) {
                       return friction(j, now_.w[j]) + forces_.contact_squared(now_, j) * std::sin(now_.u[j]);
                     })};
  };
  const auto velocity = [&](std::size_t j) { return forces_.springs().held(j) ? 0 : direction * now_.w[j]; };
  now_.fronts.look(now_.time, means(velocity), now_.log.events().size(), now_.log.in_progress() > 0, ahead);
}

void ImplicitChain::give_up() const {
  throw NumericsError("t = " + digits(now_.time) + ": no implicit step is short enough; the motion at x = " +
                      digits(problem().grid.x(step_.hardest_site())) + " cannot be followed");
}

/// Ends a run that no longer makes progress: 10,000 implicit steps advanced it by less than one explicit step would.
void ImplicitChain::check_progress() {
  constexpr long window = 10000;
  if (now_.steps % window != 0) return;
  const double advanced = now_.time - now_.window_start, explicit_step = chosen_step(problem());
  now_.window_start = now_.time;
  if (advanced > explicit_step) return;
  throw NumericsError("t = " + digits(now_.time) + ": the last " + std::to_string(window) +
                      " implicit steps advanced the chain by " + digits(advanced, 2) + " only; an explicit step is " +
                      digits(explicit_step, 2) + ". Try a larger chain.tolerance, or check for forces that change " +
                      "faster than the chain can move");
}

void ImplicitChain::finish_step() {
  if (forces_.contacts_change()) forces_.check_contacts(now_);
  if (now_.log.active()) look();
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

/// Saves the start of a step that has passed the present time; `resume` takes this step again.
std::string ImplicitChain::saved() const {
  const Moment& m = passed_ ? before_ : now_;
  std::vector<double> all{static_cast<double>(problem().grid.sites), now_.time};
  each_saved(
      m, [&](auto number) { all.push_back(static_cast<double>(number)); },
      [&](const std::vector<double>& column) { all.insert(all.end(), column.begin(), column.end()); });
  const std::vector<double> log = m.log.saved();
  all.push_back(static_cast<double>(log.size()));
  all.insert(all.end(), log.begin(), log.end());
  const std::vector<double> fronts = m.fronts.saved();
  all.insert(all.end(), fronts.begin(), fronts.end());
  bytes::Writer writer;
  writer.put(all);
  return std::move(writer).text();
}

void ImplicitChain::resume(std::string_view saved) {
  constexpr double most_steps = 9007199254740992;  // whole numbers that a double holds
  bytes::Reader reader(saved);
  const std::vector<double> all = reader.vector();
  reader.end();
  std::size_t at = 0;
  const auto refuse = [] {
    throw InputError({.key = "resume", .problem = "does not fit the scenario", .allowed = "a file of this scenario"});
  };
  const auto next = [&](double least, double most) {
    if (at >= all.size() || !(all[at] >= least && all[at] <= most)) refuse();
    return all[at++];
  };
  constexpr double largest = std::numeric_limits<double>::max();
  const double sites = static_cast<double>(problem().grid.sites);
  next(sites, sites);
  const double shown = next(-largest, largest);
  Moment m = now_;
  each_saved(
      m,
      [&]<class N>(N& number) {
        constexpr bool counts = std::is_integral_v<N>;
        number = static_cast<N>(next(counts ? 0 : -largest, counts ? most_steps : largest));
      },
      [&](std::vector<double>& column) {
        if (all.size() - at < column.size()) refuse();
        std::copy_n(all.begin() + static_cast<std::ptrdiff_t>(at), column.size(), column.begin());
        at += column.size();
      });
  forces_.strengthen_contacts(m);
  const auto log = static_cast<std::ptrdiff_t>(next(0, static_cast<double>(all.size() - at)));
  const auto begin = all.begin() + static_cast<std::ptrdiff_t>(at);
  if (all.end() - begin < log) refuse();
  m.log.resume({begin, begin + log});
  m.fronts.resume({begin + log, all.end()});
  std::swap(now_, m);
  passed_ = false;
  advance_to(shown);
}

}  // namespace slipfront::chain
