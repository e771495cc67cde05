#include "lattice/chain/explicit/contact_field.hpp"

#include <algorithm>
#include <cmath>

#include "math/digits.hpp"
#include "slipfront/error.hpp"

namespace slipfront::chain {

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
    if (p.friction.contacts_vary()) at_.push_back(contacts);
    base_.push_back(a2[i] / contacts.strength(theta[i], 0));
  }
  advance(first_, 0, theta, theta);
  before_ = now_ = next_;
}

void ContactField::advance(long first, double time, std::span<const double> theta_before,
                           std::span<const double> theta) {
  const std::size_t size = theta.size(), from = at(first);
  double* const a2 = next_.data() + from;
  if (at_.empty()) contacts_.advance(size, time, theta_before.data(), theta.data(), excess_.data() + from, a2);
  for (std::size_t i = 0; i < size; ++i) {
    const friction::Contacts& contacts = at_.empty() ? contacts_ : at_[from + i];
    if (!at_.empty()) contacts.advance(1, time, &theta_before[i], &theta[i], &excess_[from + i], &a2[i]);
    a2[i] *= base_[from + i];
    share_[from + i] = contacts.share(excess_[from + i]);
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
