// What implicit steps begin with, show, and save.

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <utility>

#include "chain/implicit/implicit.hpp"
#include "foundation/text/digits.hpp"
#include "slipfront/error.hpp"

namespace slipfront::chain {
namespace {

constexpr double turn = 2 * std::numbers::pi;

void check_implicit(const Problem& p) {
  const auto refuse = [](const char* key, std::string value, const char* problem, const char* allowed) {
    throw InputError({.key = key, .value = std::move(value), .problem = problem, .allowed = allowed});
  };
  if (!p.boundary.periodic && (p.boundary.left == End::absorbing || p.boundary.right == End::absorbing))
    refuse(p.boundary.left == End::absorbing ? "chain.left" : "chain.right", "absorbing",
           "implicit steps know no absorbing ends", "free, fixed");
  if (p.friction.sticks())
    refuse("friction.law", std::string(p.friction.name()),
           "jumps at rest, which implicit steps, and so [loading], cannot follow",
           "a law without static strength, such as rate-and-state");
  if (!(p.tolerance > 0) || !(p.tolerance <= 0.1))
    refuse("chain.tolerance", digits(p.tolerance), "out of range", "> 0 and <= 0.1");
  if (!p.substrate && p.friction.contacts().ageing > 0)
    refuse("friction.contact_ageing", digits(p.friction.contacts().ageing), "there is no substrate that could age",
           "0, or interface.contact > 0");
  const Loading& l = p.loading;
  if (!(l.stiffness >= 0) || !std::isfinite(l.stiffness))
    refuse("loading.stiffness", digits(l.stiffness), "out of range", "> 0, finite");
  if (!std::isfinite(l.velocity)) refuse("loading.velocity", digits(l.velocity), "out of range", "finite");
  if (l.acts() && l.where != Pulled::everywhere) {
    if (p.boundary.periodic) refuse("chain.periodic", "true", "a ring has no end to pull", "false");
    if ((l.where == Pulled::left ? p.boundary.left : p.boundary.right) == End::fixed)
      refuse(l.where == Pulled::left ? "chain.left" : "chain.right", "fixed", "the end that is pulled", "free");
  }
}

/// Parts of the chain that are watched for events: eight dislocations or more each, or 60 widths of one.
std::size_t number_of_places(const Problem& p, const std::vector<double>& u) {
  const double dislocations =
      std::max(std::fabs(u.front() - u.back()) / turn, std::fabs(static_cast<double>(p.boundary.charge)));
  const double length = static_cast<double>(p.grid.sites) * p.grid.spacing;
  return static_cast<std::size_t>(std::clamp(dislocations >= 8 ? dislocations / 8 : length / 60, 1.0, 64.0));
}

}  // namespace

ImplicitSteps::ImplicitSteps(const Problem& p, const Motion& start, int threads)
    : problem_(p),
      n_(p.grid.sites),
      variables_(p.friction.variables()),
      threads_(threads),
      rubs_(p.friction.acts()),
      springs_((check_implicit(p), p), start.u),
      all_contact_(p.substrate ? 1 : 0),
      contacts_(p.friction.contacts()),
      first_u_(start.u),
      matrix_(n_),
      places_(number_of_places(p, start.u)) {
  for (auto* column : {&trial_.w, &trial_.force, &trial_.slope, &trial_.theta, &trial_.shift, &trial_.friction,
                       &trial_.friction_slope, &trial_.forcing, &trial_.right, &trial_.middle})
    column->resize(n_);
  const bool has_velocity = !start.velocity.empty();
  now_.u = start.u;
  now_.v = has_velocity ? start.velocity : std::vector<double>(n_, 0.0);
  for (auto* column : {&now_.w, &now_.slope, &now_.acceleration, &now_.earlier}) column->assign(n_, 0.0);
  now_.memory.resize(variables_ * n_);
  now_.next_step = 1e-3 * std::fmin(1, p.grid.spacing);
  now_.log = EventLog(p.loading.event_velocity);
  for (std::size_t j = 0; j < now_.memory.size(); j += variables_)
    p.friction.law().start(std::span(now_.memory).subspan(j, variables_));
  start_contacts();
  for (std::size_t j = 0; j < n_; ++j) {
    if (springs_.held(j)) now_.v[j] = 0;
    now_.w[j] = now_.v[j];
    if (!rubs_) continue;
    const double step = std::fmax(1e-6 * std::fabs(now_.v[j]), smallest_velocity);
    now_.slope[j] = (friction(j, now_.v[j] + step) - friction(j, now_.v[j])) / step;
  }
}

void ImplicitSteps::start_contacts() {
  const Problem& p = problem_;
  if (contacts_.act()) now_.excess.assign(n_, 0);
  if (!(p.contact || contacts_.act()) || !p.substrate) return;
  for (std::size_t j = 0; j < n_; ++j) {
    const double a = p.contact ? p.contact(p.grid.x(j)) : 1;
    now_.a2.push_back(a * a);
  }
  if (!contacts_.act()) return;
  const double a = p.friction.contact_at_start();
  for (double& a2 : now_.a2) base_.push_back(a2 / (a * a));
  strengthen_contacts();
}

/// a^2 from the states of the sites. It is always computed in this way, so a resumed run has the same bits.
void ImplicitSteps::strengthen_contacts() {
  for (std::size_t j = 0; j < base_.size(); ++j)
    now_.a2[j] = base_[j] * contacts_.strength(now_.memory[j], now_.excess[j]);
}

double ImplicitSteps::pull(std::size_t site) const {
  const Loading& l = problem_.loading;
  if (l.where == Pulled::everywhere) return l.stiffness;
  return site == (l.where == Pulled::left ? 0 : n_ - 1) ? l.stiffness / springs_.weight(site) : 0;
}

double ImplicitSteps::forcing(std::size_t j) const {
  const double given = problem_.forcing ? problem_.forcing(problem_.grid.x(j), now_.time) : 0;
  return given + pull(j) * (problem_.loading.velocity * now_.time - (now_.u[j] - first_u_[j]));
}

double ImplicitSteps::friction(std::size_t j, double velocity) const {
  const double force =
      problem_.friction.force(velocity, friction::Memory(now_.memory).subspan(variables_ * j, variables_));
  return contacts_.act() ? effective_stress(j) * force : force;
}

double ImplicitSteps::loading_energy() const {
  double sum = 0;
  if (!problem_.loading.acts()) return 0;
  for (std::size_t j = 0; j < n_; ++j) {
    const double stretch = problem_.loading.velocity * now_.time - (now_.u[j] - first_u_[j]);
    sum += springs_.weight(j) * pull(j) * stretch * stretch / 2;
  }
  return sum;
}

Window ImplicitSteps::window(std::size_t from, std::size_t to) const {
  const double h = springs_.spacing(), charge = turn * static_cast<double>(problem_.boundary.charge);
  const long n = static_cast<long>(n_);
  const auto at = [&](long j) {  // also beyond the ends
    const auto site = [&](long i) { return now_.u[static_cast<std::size_t>(std::clamp(i, 0L, n - 1))]; };
    if (j >= 0 && j < n) return site(j);
    if (problem_.boundary.periodic) return j < 0 ? site(j + n) + charge : site(j - n) - charge;
    const long last = j < 0 ? 0 : n - 1;
    const double mirrored = site(2 * last - j);
    return springs_.held(static_cast<std::size_t>(last)) ? 2 * site(last) - mirrored : mirrored;
  };
  Window window;
  window.begin = from;
  for (std::size_t i = from; i < to; ++i) {
    const long j = static_cast<long>(i);
    window.x.push_back(problem_.grid.x(i));
    window.u.push_back(now_.u[i]);
    window.velocity.push_back(now_.v[i]);
    window.stress.push_back(problem_.model == Model::lattice
                                ? (at(j - 1) - at(j + 1)) / (2 * h)
                                : (45 * (at(j - 1) - at(j + 1)) - 9 * (at(j - 2) - at(j + 2)) + at(j - 3) - at(j + 3)) /
                                      (60 * h));
  }
  return window;
}

/// Hands the step that has just been taken to the log of events. Slip counts as positive in the direction of the
/// springs.
void ImplicitSteps::look() {
  const double direction = problem_.loading.velocity < 0 ? -1 : 1;
  Places places;
  places.length = static_cast<double>(n_) * springs_.spacing() / static_cast<double>(places_);
  const bool everywhere = problem_.loading.where == Pulled::everywhere;
  double load = 0;
  for (std::size_t j = 0; j < n_; ++j)
    if (everywhere || pull(j) > 0) load += direction * springs_.weight(j) * forcing(j);
  if (everywhere) load /= springs_.spacing() * static_cast<double>(problem_.boundary.periodic ? n_ : n_ - 1);
  for (std::size_t i = 0; i < places_; ++i) {
    const std::size_t from = n_ * i / places_, to = n_ * (i + 1) / places_;
    double u = 0, p = 0;
    for (std::size_t j = from; j < to; ++j) {
      u += direction * now_.u[j];
      p += springs_.held(j) ? 0 : direction * now_.w[j];
    }
    const double count = static_cast<double>(to - from);
    places.x.push_back((problem_.grid.x(from) + problem_.grid.x(to - 1)) / 2);
    places.u.push_back(u / count);
    places.velocity.push_back(p / count);
  }
  now_.log.look(now_.time, load, places);
}

/// Saves the start of a step that has passed the present time; `resume` takes this step again.
std::vector<double> ImplicitSteps::saved() const {
  const Moment& m = passed_ ? before_ : now_;
  std::vector<double> all{static_cast<double>(n_),
                          now_.time,
                          m.time,
                          static_cast<double>(m.steps),
                          m.last_step,
                          m.earlier_step,
                          m.next_step,
                          m.supplied,
                          m.dissipated,
                          m.by_contacts,
                          m.window_start};
  for (const auto* column : {&m.u, &m.v, &m.memory, &m.w, &m.slope, &m.acceleration, &m.earlier, &m.excess})
    all.insert(all.end(), column->begin(), column->end());
  const std::vector<double> log = m.log.saved();
  all.insert(all.end(), log.begin(), log.end());
  return all;
}

void ImplicitSteps::resume(const std::vector<double>& saved) {
  constexpr std::size_t head = 11;
  const std::size_t whole = head + (6 + variables_) * n_ + now_.excess.size();
  constexpr double most_steps = 9007199254740992;  // whole numbers that a double holds
  if (saved.size() < whole || saved[0] != static_cast<double>(n_) || !(saved[3] >= 0 && saved[3] <= most_steps) ||
      !std::all_of(saved.begin(), saved.begin() + head, [](double value) { return std::isfinite(value); }))
    throw InputError({.key = "resume", .problem = "does not fit the scenario", .allowed = "a file of this scenario"});
  const double shown = saved[1];
  now_.time = saved[2];
  now_.steps = static_cast<long>(saved[3]);
  now_.last_step = saved[4];
  now_.earlier_step = saved[5];
  now_.next_step = saved[6];
  now_.supplied = saved[7];
  now_.dissipated = saved[8];
  now_.by_contacts = saved[9];
  now_.window_start = saved[10];
  auto from = saved.begin() + head;
  for (auto* column :
       {&now_.u, &now_.v, &now_.memory, &now_.w, &now_.slope, &now_.acceleration, &now_.earlier, &now_.excess}) {
    std::copy_n(from, column->size(), column->begin());
    from += static_cast<std::ptrdiff_t>(column->size());
  }
  strengthen_contacts();
  now_.log.resume({from, saved.end()});
  passed_ = false;
  advance(shown, std::numeric_limits<long>::max());
}

}  // namespace slipfront::chain
