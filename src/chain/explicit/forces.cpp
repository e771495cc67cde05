#include "chain/explicit/forces.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>
#include <utility>

#include "foundation/math/constants.hpp"

namespace slipfront::chain {
namespace {

constexpr std::size_t together = 64;  ///< sites in one pass of the friction loops; a pass with no moving site is cheap

/// Number of sites by which arrays extend past both ends. A chain that advances many levels at a time needs a^2 in its
/// halos too, up to whole vectors.
long margin_of(const Problem& p) {
  return static_cast<long>(p.forcing || p.friction.state_size() > 0 ? margin : halo + 2 * lanes);
}

/// a(x)^2 on sites [first, last). It is empty if a is 1 everywhere and does not change.
std::vector<double> a2_of(const Problem& p, long first, long last) {
  std::vector<double> a2;
  const bool changes = p.friction.changes_contacts();
  if (!p.contact && !changes) return a2;
  for (long j = first; j < last; ++j) {
    const double a = p.contact ? p.contact(p.grid.x(folded(p, j))) : 1;
    a2.push_back(a * a);
  }
  return a2;
}

}  // namespace

Forces::Forces(const Problem& problem, const Scheme& scheme, long level, std::size_t begin, std::size_t end)
    : problem_(problem),
      scheme_(scheme),
      sine_(substrate_force(0)),
      dt_(scheme.dt),
      level_(level),
      first_(static_cast<long>(begin) - margin_of(problem)),
      last_(static_cast<long>(end) + margin_of(problem)),
      nonlinear_(problem.friction.acts() && !problem.friction.linear_coefficient()),
      variables_(problem.friction.state_size()),
      state_(variables_ * at(last_)),
      a2_(a2_of(problem_, first_, last_)),
      contacts_(problem_, first_, a2_) {
  for (long j = first_; variables_ > 0 && j < last_; ++j)
    problem_.friction.start(problem_.grid.x(folded(problem_, j)), 0, {state_of(j), variables_});
  if (problem_.forcing) {
    F_now_.resize(at(last_));
    evaluate_forcing(problem_.steady_forcing ? 0 : level_, F_now_);
    if (problem_.steady_forcing) return;
    F_before_ = F_next_ = F_now_;
    evaluate_forcing(level_ + 1, F_next_);
    evaluate_forcing(level_ - 1, F_before_);
  }
}

void Forces::evaluate_forcing(long level, std::vector<double>& F) const {
  if (level < 0) {  // F need not be defined before the start, so we extrapolate
    std::vector<double> zero = F, one = F, two = F;
    evaluate_forcing(0, zero);
    evaluate_forcing(1, one);
    evaluate_forcing(2, two);
    for (std::size_t j = 0; j < F.size(); ++j) F[j] = 3 * zero[j] - 3 * one[j] + two[j];
    return;
  }
  const double t = static_cast<double>(level) * dt_;
  for (long j = first_; j < last_; ++j) F[at(j)] = problem_.forcing(problem_.grid.x(folded(problem_, j)), t);
}

void Forces::age(long first, std::size_t size, const double* now, const double* next) {
  if (variables_ == 0) return;
  double velocity[together];
  for (std::size_t j = 0; j < size; j += together) {
    const std::size_t some = std::min(together, size - j);
    velocities(turn / dt_, now + j, next + j, velocity, some);
    if (contacts_.acts()) {
      age_contacts(first + static_cast<long>(j), some, velocity);
      continue;
    }
    problem_.friction.evolution().advance_all(some, friction::Slips::at(velocity), dt_, variables_,
                                              state_of(first + static_cast<long>(j)));
  }
}

void Forces::age_contacts(long first, std::size_t size, const double* velocity) {
  double before[together];
  double* const theta = state_of(first);
  std::copy_n(theta, size, before);
  problem_.friction.evolution().advance_all(size, friction::Slips::at(velocity), dt_, variables_, theta);
  contacts_.advance(first, dt_, {before, size}, {theta, size});
}

std::vector<double> Forces::states(std::size_t begin, std::size_t end) const {
  if (!contacts_.acts()) return {state_of(static_cast<long>(begin)), state_of(static_cast<long>(end))};
  std::vector<double> all(state_size() * (end - begin));
  for (std::size_t j = begin; j < end; ++j) {
    double* const to = all.data() + state_size() * (j - begin);
    std::copy_n(state_of(static_cast<long>(j)), variables_, to);
    contacts_.save(j, to + variables_);
  }
  return all;
}

void Forces::set_states(std::size_t begin, const std::vector<double>& states) {
  for (std::size_t i = 0; i < states.size(); i += state_size()) {
    const std::size_t site = begin + i / state_size();
    std::copy_n(states.data() + i, variables_, state_of(static_cast<long>(site)));
    if (contacts_.acts()) contacts_.resume(site, states[i], states.data() + i + variables_);
  }
}

void Forces::exchange(const Ranks& ranks) {
  if (contacts_.acts()) contacts_.exchange(ranks);
}

void Forces::exchange_all(const Ranks& ranks) {
  exchange(ranks);
  if (contacts_.acts()) contacts_.exchange_all(ranks);
  if (variables_ > 0) fill_margins(problem_, ranks, first_, variables_, state_);
}

void Forces::proceed() {
  ++level_;
  if (contacts_.acts()) contacts_.proceed();
  if (steady()) return;
  F_before_.swap(F_now_);
  F_now_.swap(F_next_);
  evaluate_forcing(level_ + 1, F_next_);
}

void Forces::steps_from(long j, std::size_t size, const double* before, const double* now, const double* next,
                        double* u, double* D, double* B) const {
  if (a2_.empty()) {
    take_steps(scheme_.rule.f, scheme_.eps, before, now, next, u, D, B, size);
    return;
  }
  const double* a2_next = contacts_.acts() ? contacts_.next(j) : a2(j);
  take_steps(scheme_.contact, scheme_.eps, a2_next, before, now, next, u, D, B, size);
}

void Forces::displacements_from(long j, std::size_t size, const double* z, double* u) const {
  if (a2_.empty())
    displacements(scheme_.rule.f, scheme_.eps, z, u, size);
  else
    displacements(scheme_.contact, scheme_.eps, a2(j), z, u, size);
}

void Forces::level(const EndConditions& ends, long offset, std::size_t size, const double* before, const double* now,
                   double* next, double* y, Outflow& outflow, double* applied) const {
  if (!a2_.empty()) {
    const double* a2 = this->a2(offset - 1);
    local_part_with_contact(scheme_.rule, scheme_.contact, a2, now - 1, before - 1, next - 1, y - 1, 0, size + 2);
  } else {
    local_part(scheme_.rule, now - 1, before - 1, next - 1, y - 1, 0, (size + 2 + lanes - 1) / lanes * lanes);
  }
  // Indices count from two sites before the first, so that they are not negative on the other side of a seam.
  const EndSites bare = before_neighbours(ends, next - 2, 2, size + 1);
  add_neighbours(scheme_.rule.spread, y, next, 0, (size + lanes - 1) / lanes * lanes);
  const auto given = [](EndCondition side) { return side == EndCondition::fixed || side == EndCondition::absorbing; };
  const std::size_t from = given(ends.left) ? 1 : 0, to = given(ends.right) ? size - 1 : size;
  mend_ends(ends, bare, scheme_.rule.spread, now - 2, y - 2, next - 2, 2, size + 1, outflow);
  if (!F_now_.empty()) {
    const long first = offset + static_cast<long>(from);
    const double strength = scheme_.force / turn;
    const DriveRule rule{strength * scheme_.share_next, strength * scheme_.share_before, strength * scheme_.share_now,
                         strength * scheme_.share_neighbour};
    add_drive(rule, F_before(first), F_now(first), F_next(first), next + from, to - from);
  }
  if (!nonlinear_) return;
  if (applied != nullptr) applied[0] = applied[size - 1] = 0;
  add_friction(offset, from, to, before, now, next, applied);
}

void Forces::add_friction(long offset, std::size_t begin, std::size_t end, const double* before, const double* now,
                          double* next, double* applied) const {
  const friction::Friction& f = problem_.friction;
  if (const auto strength = f.constant_strength()) {
    shorten_steps(dt_ * dt_ * *strength / turn, now + begin, next + begin, end - begin);
    return;
  }
  // Friction is centred on the level if that is stable. A law that is steep at rest acts on the half step after the
  // level instead. It can then stop a site, but not reverse its velocity.
  const bool centred = !f.steep_at_rest();
  const double time = centred ? 2 * dt_ : dt_, weight = dt_ * dt_ / time;
  double free[together], speed[together];
  for (std::size_t j = begin; j < end; j += together) {
    const std::size_t some = std::min(together, end - j);
    const double* from = (centred ? before : now) + j;
    double* force = applied == nullptr ? nullptr : applied + j;
    if (!free_speeds(turn / time, from, next + j, free, some)) {
      if (force != nullptr) std::fill_n(force, some, 0.0);
      std::copy_n(from, some, next + j);
      continue;
    }
    const long site = offset + static_cast<long>(j);
    const friction::LocalStates states = states_from(site);
    if (contacts_.have_pressure())
      f.loops().speeds_after_under(some, contacts_.share(site), free, weight, states, speed);
    else
      f.loops().speeds_after(some, free, weight, states, speed);
    take_speeds(turn / time, 1 / weight, from, free, speed, next + j, force, some);
  }
}

double Forces::work_of_friction(long j, std::size_t size, const double* D, const double* applied) const {
  if (problem_.friction.steep_at_rest()) return sum_of_products(applied, D, size);
  double speed[together], force[together], sum = 0;
  for (std::size_t at = 0; at < size; at += together) {
    const std::size_t some = std::min(together, size - at);
    for (std::size_t i = 0; i < some; ++i) speed[i] = std::fabs(D[at + i]) / dt_;
    problem_.friction.loops().strengths(some, speed, states_from(j + static_cast<long>(at)), force);
    sum += dt_ * sum_of_products(force, speed, some);
  }
  return sum;
}

double Forces::energy_of_contacts(long j, std::size_t size, const double* u, const double* D) const {
  return chain::energy_of_contacts(sine_, contacts_.now(j), contacts_.next(j), u, D, size);
}

}  // namespace slipfront::chain
