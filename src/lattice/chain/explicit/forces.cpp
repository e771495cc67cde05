#include "lattice/chain/explicit/forces.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>
#include <utility>

#include "lattice/chain/explicit/levels/kernel.hpp"
#include "math/constants.hpp"
#include "math/digits.hpp"
#include "slipfront/error.hpp"

namespace slipfront::chain {
namespace {

constexpr double tolerance = 1e-13, infinity = std::numeric_limits<double>::infinity();

/// Chebyshev's node i of n on [-1, 1].
double node(std::size_t i, std::size_t n) {
  return std::cos(std::numbers::pi * (static_cast<double>(i) + 0.5) / static_cast<double>(n));
}

}  // namespace

void ForcingInTime::at(long level, const Ranks& ranks) {
  if (level + 1 < begin_ || level + 1 >= end_) choose(level + 1, ranks);
  weights_.clear();
  if (!polynomial_) {
    call_formula(level);
    for (std::size_t i = 0; i < 3; ++i) {
      weights_.emplace_back();
      weights_.back()[i] = 1;
    }
    return;
  }
  for (long l = level - 1; l < std::min(end_, level + static_cast<long>(halo) + 1); ++l)
    weights_.push_back(of_terms(static_cast<double>(l)));
  if (level > 0) return;
  for (std::size_t s = 0; s < terms_.size(); ++s)
    weights_[0][s] = 3 * weights_[1][s] - 3 * weights_[2][s] + weights_[3][s];
}

/// F at three levels. Two of them are known from a call for the level before.
void ForcingInTime::call_formula(long level) {
  resize_terms(3);
  const auto call = [&](std::size_t i, long at) {
    double* const F = terms_[i].data();
    for (std::size_t j = 0; j < x_.size(); ++j) F[j] = formula(j, static_cast<double>(at));
  };
  if (called_ == level - 1 && level > 0) {
    std::swap(terms_[0], terms_[1]);
    std::swap(terms_[1], terms_[2]);
  } else {
    call(0, level == 0 ? 2 : level - 1);
    call(1, level);
  }
  call(2, level + 1);
  double *const before = terms_[0].data(), *const now = terms_[1].data(), *const next = terms_[2].data();
  for (std::size_t j = 0; level == 0 && j < x_.size(); ++j) before[j] += 3 * now[j] - 3 * next[j];
  called_ = level;
}

void ForcingInTime::resize_terms(std::size_t count) {
  while (terms_.size() < count) terms_.emplace_back(x_.size());
  terms_.resize(count);
}

ForceTerms ForcingInTime::terms(std::size_t site) const {
  ForceTerms F{.count = terms_.size()};
  for (std::size_t s = 0; s < F.count; ++s) F.X[s] = terms_[s].data() + site;
  return F;
}

double ForcingInTime::operator()(std::size_t site, long levels_after) const {
  double sum = 0;
  for (std::size_t s = 0; s < terms_.size(); ++s) sum += weights(levels_after)[s] * terms_[s].data()[site];
  return sum;
}

/// Chooses levels [begin, end), and the nodes in them.
void ForcingInTime::choose_levels(long begin, long end) {
  begin_ = begin;
  end_ = end;
  const auto from = static_cast<double>(std::max(begin - 2, 0L)), until = static_cast<double>(end);
  for (std::size_t i = 0; i < nodes; ++i) {
    level_of_node_[i] = 0.5 * (from + until) + 0.5 * (until - from) * node(i, nodes);
    const double angle = std::numbers::pi * (static_cast<double>(i) + 0.5) / static_cast<double>(nodes);
    barycentric_[i] = (i % 2 == 0 ? 1 : -1) * std::sin(angle);
  }
}

/// The weights of the values at the nodes in the value at a level, by the barycentric formula.
ForcingInTime::NodeWeights ForcingInTime::of_nodes(double level) const {
  NodeWeights weight{};
  double sum = 0;
  for (std::size_t i = 0; i < nodes; ++i) {
    const double away = level - level_of_node_[i];
    if (away == 0) {
      weight.fill(0);
      weight[i] = 1;
      return weight;
    }
    weight[i] = barycentric_[i] / away;
    sum += weight[i];
  }
  for (double& w : weight) w /= sum;
  return weight;
}

ForceTerms::Weights ForcingInTime::of_terms(double level) const {
  const NodeWeights nodes_at_level = of_nodes(level);
  ForceTerms::Weights weight{};
  for (std::size_t s = 0; s < terms_.size(); ++s)
    for (std::size_t i = 0; i < nodes; ++i) weight[s] += nodes_of_terms_[s][i] * nodes_at_level[i];
  return weight;
}

/// Takes the longest polynomial that is right. Its levels begin at a multiple of their number, whatever came before.
void ForcingInTime::choose(long level, const Ranks& ranks) {
  for (long levels = longest; levels >= shortest; levels /= 2) {
    choose_levels(level / levels * levels, level / levels * levels + levels);
    polynomial_ = fits(ranks) && decompose(ranks);
    if (polynomial_) return;
  }
}

/// Writes the values at the nodes as a sum of weights times terms, by LU decomposition with complete pivoting. All
/// ranks take the same pivots: the first of the largest numbers, site by site.
bool ForcingInTime::decompose(const Ranks& ranks) {
  constexpr std::size_t columns = nodes + 1;
  resize_terms(0);
  called_ = -1;
  nodes_of_terms_.clear();
  for (;;) {
    std::vector<double> mine(columns);  // the largest number of this rank, and the values at its site
    for (std::size_t j = 0; j < x_.size(); ++j) {
      double most = mine[nodes];
      for (const auto& row : values_) most = std::max(most, std::fabs(row[j]));
      if (most == mine[nodes]) continue;
      mine[nodes] = most;
      for (std::size_t i = 0; i < nodes; ++i) mine[i] = values_[i][j];
    }
    const std::vector<double> all = ranks.joined(mine);
    std::size_t best = 0;
    for (std::size_t r = 1; r * columns < all.size(); ++r)
      if (all[r * columns + nodes] > all[best * columns + nodes]) best = r;
    const std::span<const double> column(all.data() + best * columns, nodes);
    if (!(all[best * columns + nodes] > tolerance / 4 * most_)) return true;
    if (terms_.size() == ForceTerms::most) return false;
    std::size_t pivot = 0;
    for (std::size_t i = 1; i < nodes; ++i)
      if (std::fabs(column[i]) > std::fabs(column[pivot])) pivot = i;
    resize_terms(terms_.size() + 1);
    double* const term = terms_.back().data();
    std::copy(values_[pivot].begin(), values_[pivot].end(), term);
    NodeWeights& of_nodes = nodes_of_terms_.emplace_back();
    for (std::size_t i = 0; i < nodes; ++i) {
      of_nodes[i] = column[i] / column[pivot];
      for (std::size_t j = 0; j < x_.size(); ++j) values_[i][j] -= of_nodes[i] * term[j];
    }
  }
}

void ForcingInTime::fill(std::size_t stride) {
  for (std::size_t i = 0; i < nodes; ++i) {
    values_[i].resize(x_.size());
    for (std::size_t j = 0; j < x_.size(); j += stride) {
      values_[i][j] = formula(j, level_of_node_[i]);
      most_ = std::max(most_, std::fabs(values_[i][j]));
    }
  }
}

/// The largest difference from the formula at a level, at every 256th site from `first` on.
double ForcingInTime::largest_error(long level, std::size_t first) const {
  const auto weight = of_nodes(static_cast<double>(level));
  double most = 0;
  for (std::size_t j = first; j < x_.size(); j += apart()) {
    double sum = 0;
    for (std::size_t i = 0; i < nodes; ++i) sum += weight[i] * values_[i][j];
    const double error = std::fabs(sum - formula(j, static_cast<double>(level)));
    if (std::isnan(error)) return infinity;
    most = std::fmax(most, error);
  }
  return most;
}

bool ForcingInTime::fits(const Ranks& ranks) {
  const auto most_of_all = [&](double mine) {
    if (ranks.size() == 1) return mine;
    double most = 0;
    for (const double theirs : ranks.joined({mine})) most = std::fmax(most, theirs);
    return most;
  };
  // A formula need not have values after the end of a run.
  const auto error_of = [](const auto& measure) {
    try {
      return measure();
    } catch (const InputError&) {
      return infinity;
    }
  };
  most_ = 0;
  const double at_first_sites = error_of([&] {  // a few calls refuse most polynomials that are too long
    fill(apart());
    return largest_error(begin_ + 1, 0);
  });
  most_ = most_of_all(most_);
  if (most_of_all(at_first_sites) > tolerance * most_) return false;
  const double at_nodes = error_of([&] {
    fill(1);
    return 0.0;
  });
  most_ = most_of_all(most_);
  const double error = error_of([&] {
    double most = at_nodes;
    for (long level = begin_; level < end_ && most <= tolerance * most_; ++level)
      most = std::fmax(most, largest_error(level, static_cast<std::size_t>(level) * 29 % apart()));
    return most;
  });
  return most_of_all(error) <= tolerance * most_;
}

namespace {

constexpr std::size_t together = 256;  ///< sites in one pass of the loops over states

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

Forces::Forces(const Problem& problem, const Scheme& scheme, const Ranks& ranks, long level, std::size_t begin,
               std::size_t end)
    : problem_(problem),
      scheme_(scheme),
      sine_(substrate_force(0)),
      dt_(scheme.dt),
      level_(level),
      first_(static_cast<long>(begin) - static_cast<long>(margin)),
      last_(static_cast<long>(end + margin)),
      nonlinear_(problem.friction.acts() && !problem.friction.linear_coefficient()),
      variables_(problem.friction.state_size()),
      state_(variables_ * at(last_)),
      a2_(a2_of(problem_, first_, last_)),
      contacts_(problem_, first_, a2_),
      steady_(!problem.forcing || problem.steady_forcing) {
  for (long j = first_; variables_ > 0 && j < last_; ++j)
    problem_.friction.start(problem_.grid.x(folded(problem_, j)), 0, {state_of(j), variables_});
  if (!problem_.forcing) return;
  std::vector<double> x;
  for (long j = first_; j < last_; ++j) x.push_back(problem_.grid.x(folded(problem_, j)));
  if (!steady_) {
    forcing_ = ForcingInTime(problem_.forcing, std::move(x), dt_);
    forcing_.at(level_, ranks);
    return;
  }
  for (const double at : x) steady_F_.push_back(problem_.forcing(at, 0));
  steady_drive_.resize(at(last_));
  const double all = scheme_.share_next + scheme_.share_before + scheme_.share_now, strength = scheme_.force / turn;
  for (std::size_t j = 1; j + 1 < at(last_); ++j)
    steady_drive_[j] =
        strength * (all * steady_F_[j] + scheme_.share_neighbour * (steady_F_[j - 1] + steady_F_[j + 1]));
}

void Forces::age(long first, std::size_t size, const double* now, const double* next, friction::EvolvingStates states) {
  double velocity[together];
  for (std::size_t j = 0; j < size; j += together) {
    const std::size_t some = std::min(together, size - j);
    velocities(turn / dt_, now + j, next + j, velocity, some);
    const friction::EvolvingStates theirs = states.from(j);
    if (contacts_.acts())
      age_contacts(first + static_cast<long>(j), some, velocity, theirs);
    else
      problem_.friction.evolution().advance_all(some, friction::Slips::at(velocity), dt_, theirs);
  }
}

void Forces::age_contacts(long first, std::size_t size, const double* velocity, friction::EvolvingStates states) {
  double before[together], theta[together];
  for (std::size_t i = 0; i < size; ++i) before[i] = states(i, 0);
  problem_.friction.evolution().advance_all(size, friction::Slips::at(velocity), dt_, states);
  for (std::size_t i = 0; i < size; ++i) theta[i] = states(i, 0);
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
  if (variables_ > 0) fill_margins(problem_, ranks, first_, variables_, state_);
}

void Forces::exchange_all(const Ranks& ranks) {
  exchange(ranks);
  if (contacts_.acts()) contacts_.exchange_all(ranks);
}

void Forces::proceed(std::size_t levels, const Ranks& ranks) {
  if (contacts_.acts()) contacts_.proceed();
  level_ += static_cast<long>(levels);
  if (!steady_) forcing_.at(level_, ranks);
}

void Forces::contact_coefficients(long offset, std::size_t begin, std::size_t end, double* coefficients) const {
  if (!a2_.empty()) chain::contact_coefficients(scheme_.contact, a2(offset), coefficients, begin, end);
}

void Forces::next_coefficients(long offset, std::size_t begin, std::size_t end, double* coefficients) const {
  chain::contact_coefficients(scheme_.contact, contacts_.next(offset), coefficients, begin, end);
}

/// The sites of a level that begin_level computes, in whole vectors: the second loop needs y of one more site on each
/// side that is no end.
Forces::Range Forces::range_of(const EndConditions& ends, const LevelSites& s) {
  return {(is_end(ends.left) ? s.left : s.left - 1) / lanes * lanes,
          ((is_end(ends.right) ? s.right : s.right + 1) + lanes - 1) / lanes * lanes};
}

/// The part of it where Coulomb friction shortens steps in the same loop: without a load, and without the vector of an
/// end, which changes after this loop. An absorbing end and a seam change more sites, or need steps without friction.
Forces::Range Forces::shortened_at_once(const EndConditions& ends, const Range& all) const {
  const Range none{all.end, all.end};
  if (problem_.forcing || !nonlinear_ || !problem_.friction.constant_strength()) return none;
  for (const EndCondition side : {ends.left, ends.right})
    if (side == EndCondition::absorbing || side == EndCondition::seam) return none;
  const Range part{all.begin + (is_end(ends.left) ? lanes : 0), all.end - (is_end(ends.right) ? lanes : 0)};
  return part.begin < part.end ? part : none;
}

double Forces::longest_hold() const { return dt_ * dt_ * *problem_.friction.constant_strength() / turn; }

void Forces::local_part(const LevelSites& s, std::size_t begin, std::size_t end) const {
  if (s.coefficients != nullptr)
    local_part_with_coefficients(scheme_.rule, s.coefficients, s.now, s.before, s.next, s.y, begin, end, s.step);
  else
    chain::local_part(scheme_.rule, s.now, s.before, s.next, s.y, begin, end, s.step);
}

void Forces::begin_level(const EndConditions& ends, const LevelSites& s, Outflow& outflow) const {
  const auto [begin, end] = range_of(ends, s);
  local_part(s, begin, end);
  const auto index = [&s](long site) { return static_cast<std::size_t>(site - s.offset); };
  const std::size_t first = index(0), last = index(static_cast<long>(problem_.grid.sites) - 1);
  const EndSites bare = before_neighbours(ends, s.next, first, last);
  const auto [from, to] = shortened_at_once(ends, {begin, end});
  const double spread = scheme_.rule.spread;
  add_neighbours(spread, s.y, s.next, begin, from);
  if (from < to) add_neighbours_and_shorten(spread, longest_hold(), s.y, s.now, s.next, from, to);
  add_neighbours(spread, s.y, s.next, to, end);
  mend_ends(ends, bare, scheme_.rule.spread, s.now, s.y, s.next, first, last, outflow);
}

void Forces::add_load_and_friction(const EndConditions& ends, const LevelSites& s) const {
  const auto given = [](EndCondition side) { return side == EndCondition::fixed || side == EndCondition::absorbing; };
  const std::size_t from = given(ends.left) ? s.left + 1 : s.left, to = given(ends.right) ? s.right - 1 : s.right;
  if (problem_.forcing) {  // whole vectors, where sites of neighbours may be passed
    const std::size_t first = is_end(ends.left) ? from : from / lanes * lanes;
    add_load(s, first, is_end(ends.right) ? to : (to + lanes - 1) / lanes * lanes);
  }
  if (!nonlinear_) return;
  if (s.applied != nullptr) s.applied[s.left] = s.applied[s.right - 1] = 0;  // ends that are given have none
  const Range done = shortened_at_once(ends, range_of(ends, s));
  add_friction(s, from, std::min(done.begin, to));
  add_friction(s, std::max(done.end, from), to);
}

void Forces::add_load(const LevelSites& s, std::size_t begin, std::size_t end) const {
  const long first = s.offset + static_cast<long>(begin);
  if (steady_) {
    add_steady_drive(steady_drive_.data() + at(first), s.next + begin, end - begin);
    return;
  }
  const double strength = scheme_.force / turn;
  const auto &before = weights(s.ahead - 1), &now = weights(s.ahead), &next = weights(s.ahead + 1);
  ForceTerms::Weights own{}, of_neighbours{};
  for (std::size_t i = 0; i < own.size(); ++i) {
    own[i] = strength * (scheme_.share_next * next[i] + scheme_.share_before * before[i] + scheme_.share_now * now[i]);
    of_neighbours[i] = strength * scheme_.share_neighbour * now[i];
  }
  add_drive(terms(first), own, of_neighbours, s.next + begin, end - begin);
}

void Forces::add_friction(const LevelSites& s, std::size_t begin, std::size_t end) const {
  const friction::Friction& f = problem_.friction;
  if (begin >= end) return;
  if (f.constant_strength()) {
    shorten_steps(longest_hold(), s.now + begin, s.next + begin, end - begin);
    return;
  }
  // Friction is centred on the level if that is stable. A law that is steep at rest acts on the half step after the
  // level instead. It can then stop a site, but not reverse its velocity.
  const bool centred = !f.steep_at_rest();
  const double time = centred ? 2 * dt_ : dt_, weight = dt_ * dt_ / time;
  const double* const share =
      contacts_.have_pressure() ? contacts_.share(s.offset + static_cast<long>(begin)) : nullptr;
  f.loops().slow_steps(end - begin, {turn / time, (centred ? s.before : s.now) + begin, s.next + begin}, share, weight,
                       s.states.from(begin), s.applied == nullptr || centred ? nullptr : s.applied + begin);
}

std::size_t folded(const Problem& p, long j) {
  const long n = static_cast<long>(p.grid.sites);
  if (p.boundary.periodic) return static_cast<std::size_t>((j % n + n) % n);
  while (j < 0 || j >= n) j = j < 0 ? -j : 2 * (n - 1) - j;
  return static_cast<std::size_t>(j);
}

void fill_margins(const Problem& p, const Ranks& ranks, long first, std::size_t columns, std::vector<double>& values) {
  const long n = static_cast<long>(p.grid.sites), last = first + static_cast<long>(values.size() / columns);
  if (ranks.size() > 1) {  // each rank has more sites than a margin
    const std::span<double> all(values);
    const std::size_t room = columns * margin;
    ranks.exchange(all.subspan(room, room), all.subspan(all.size() - 2 * room, room), all.first(room), all.last(room),
                   p.boundary.periodic);
    if (p.boundary.periodic) return;
  }
  const auto site = [&](long j) { return values.begin() + (j - first) * static_cast<long>(columns); };
  const auto copy = [&](long j) { std::copy_n(site(static_cast<long>(folded(p, j))), columns, site(j)); };
  for (long j = first; j < 0; ++j) copy(j);
  for (long j = n; j < last; ++j) copy(j);
}

std::vector<std::string> state_names(const Problem& p) {
  std::vector<std::string> names = p.friction.state_names();
  if (p.friction.changes_contacts()) names.insert(names.end(), {"excess_pressure", "earlier_contact"});
  return names;
}

ContactField::ContactField(const Problem& p, long first, const std::vector<double>& a2)
    : problem_(&p), contacts_(p.friction.contacts()), first_(first) {
  if (!acts()) return;
  before_ = now_ = next_ = a2;
  const double most = largest_contact(p);
  limit_ = most * most;
  excess_.assign(a2.size(), 0);
  share_.assign(a2.size(), 1);
  // We compute the contacts at t = 0 from the state, with the same operations as later. A resumed run has only the
  // state to compute them from, and must get the same bits.
  std::vector<double> theta(a2.size()), state(p.friction.state_size());
  for (std::size_t i = 0; i < a2.size(); ++i) {
    p.friction.start(p.grid.x(folded(p, first_ + static_cast<long>(i))), 0, state);
    theta[i] = state[0];
    const friction::Contacts contacts = p.friction.contacts_at(state);
    if (p.friction.contacts_vary()) varying_.add(contacts);
    base_.push_back(a2[i] / contacts.strength(theta[i], 0));
  }
  advance(first_, 0, theta, theta);
  before_ = now_ = next_;
}

void ContactField::advance(long first, double time, std::span<const double> theta_before,
                           std::span<const double> theta) {
  const std::size_t size = theta.size(), from = at(first);
  double *const a2 = next_.data() + from, *const excess = excess_.data() + from;
  if (varying_.empty())
    contacts_.advance(size, time, theta_before.data(), theta.data(), excess, a2);
  else
    varying_.advance(from, size, time, theta_before.data(), theta.data(), excess, a2);
  for (std::size_t i = 0; i < size; ++i) {
    a2[i] *= base_[from + i];
    share_[from + i] = 1 - ((varying_.empty() ? contacts_.ambient : varying_.ambient(from + i)) + excess[i]);
  }
  // A fixed end keeps its a^2. The scheme fixes z = u + eps a^2 sin u there, so u would move if a^2 changed.
  const Boundary& ends = problem_->boundary;
  const long right = static_cast<long>(problem_->grid.sites) - 1;
  const auto hold = [&](long end) {
    if (end >= first && end < first + static_cast<long>(size)) next_[at(end)] = *now(end);
  };
  if (!ends.periodic && ends.left == End::fixed) hold(0);
  if (!ends.periodic && ends.right == End::fixed) hold(right);
}

/// Extrapolates a^2 to the next level, for use until `advance` computes it.
void ContactField::look_ahead() {
  for (std::size_t i = 0; i < now_.size(); ++i) next_[i] = 2 * now_[i] - before_[i];
}

void ContactField::exchange_all(const Ranks& ranks) {
  for (std::vector<double>* values : {&before_, &next_, &share_}) fill_margins(*problem_, ranks, first_, 1, *values);
}

void ContactField::proceed() {
  before_.swap(now_);
  now_.swap(next_);
  look_ahead();
}

void ContactField::check(double time) const {
  const auto fails = [&](long j, const std::string& problem) {
    throw NumericsError("t = " + digits(time) + ": at x = " + digits(problem_->grid.x(static_cast<std::size_t>(j))) +
                        ' ' + problem);
  };
  const double limit = 1.01 * limit_;  // 1 % more, because the step has a margin
  std::size_t bad = 0;
  for (long j = begin(); j < end(); ++j) bad += *share(j) > 0 && *now(j) <= limit ? 0u : 1u;
  for (long j = begin(); bad != 0 && j < end(); ++j) {
    if (!(*share(j) > 0))
      fails(j, "the pore pressure has reached the normal stress: the effective normal stress is " + digits(*share(j)) +
                   " of it");
    if (!(*now(j) <= limit))
      fails(j, "contacts have become stronger than the time step allows: a^2 is " + digits(*now(j)) + ", at most " +
                   digits(limit_));
  }
}

void ContactField::save(std::size_t site, double* to) const {
  to[0] = excess_[at(static_cast<long>(site))];
  to[1] = *before(static_cast<long>(site));
}

void ContactField::resume(std::size_t site, double theta, const double* from) {
  const long j = static_cast<long>(site);
  excess_[at(j)] = from[0];
  before_[at(j)] = from[1];
  advance(j, 0, {&theta, 1}, {&theta, 1});
  now_[at(j)] = *next(j);
}

}  // namespace slipfront::chain
