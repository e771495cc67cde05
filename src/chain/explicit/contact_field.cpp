#include "chain/explicit/contact_field.hpp"

#include <algorithm>
#include <cmath>

#include "foundation/text/digits.hpp"
#include "slipfront/error.hpp"

namespace slipfront::chain {

std::size_t folded(const Problem& p, long j) {
  const long n = static_cast<long>(p.grid.sites);
  if (p.boundary.periodic) return static_cast<std::size_t>((j % n + n) % n);
  while (j < 0 || j >= n) j = j < 0 ? -j : 2 * (n - 1) - j;
  return static_cast<std::size_t>(j);
}

std::vector<std::string_view> state_names(const Problem& p) {
  std::vector<std::string_view> names;
  for (const friction::StateVariable& variable : p.friction.definition().state) names.push_back(variable.name);
  if (p.friction.changes_contacts()) names.insert(names.end(), {"excess_pressure", "earlier_contact"});
  return names;
}

ContactField::ContactField(const Problem& p, long first, const std::vector<double>& a2)
    : problem_(&p), contacts_(p.friction.contacts()), first_(first), sites_(static_cast<long>(p.grid.sites)) {
  if (!acts()) return;
  before_ = now_ = next_ = a2;
  const double start = p.friction.contact_at_start(), growth = p.friction.contact_growth(p.longest);
  for (long j = 0; j < sites_; ++j) {
    base_.push_back(now_[at(j)] / (start * start));
    limit_ = std::fmax(limit_, now_[at(j)] * growth * growth);
  }
  excess_.assign(p.grid.sites, 0);
  share_.assign(a2.size(), 1 - contacts_.ambient);
  // We compute the contacts at t = 0 from the state, with the same operations as later. A resumed run has only the
  // state to compute them from, and must get the same bits.
  std::vector<double> theta(p.grid.sites);
  for (double& age : theta) p.friction.evolution().start({&age, 1});
  advance(0, 0, theta, theta);
  std::copy_n(next_.begin() - first_, sites_, now_.begin() - first_);
  before_ = now_;
  look_ahead();
}

void ContactField::advance(long first, double time, std::span<const double> theta_before,
                           std::span<const double> theta) {
  const std::size_t size = theta.size(), from = static_cast<std::size_t>(first);
  double* const a2 = next_.data() + at(first);
  contacts_.advance(size, time, theta_before.data(), theta.data(), excess_.data() + from, a2);
  for (std::size_t i = 0; i < size; ++i) {
    a2[i] *= base_[from + i];
    share_[at(first) + i] = contacts_.share(excess_[from + i]);
  }
  // A fixed end keeps its a^2. The scheme fixes z = u + eps a^2 sin u there, so u would move if a^2 changed.
  const Boundary& ends = problem_->boundary;
  if (first == 0 && !ends.periodic && ends.left == End::fixed) a2[0] = *now(0);
  if (first + static_cast<long>(size) == sites_ && !ends.periodic && ends.right == End::fixed)
    a2[size - 1] = *now(sites_ - 1);
}

/// Extrapolates a^2 to the next level, for use until `advance` computes it, and fills the arrays past the ends.
void ContactField::look_ahead() {
  for (std::size_t i = 0; i < now_.size(); ++i) next_[i] = 2 * now_[i] - before_[i];
  const long last = first_ + static_cast<long>(now_.size());
  for (std::vector<double>* field : {&before_, &now_, &next_, &share_}) {
    for (long j = first_; j < 0; ++j) (*field)[at(j)] = (*field)[at(static_cast<long>(folded(*problem_, j)))];
    for (long j = sites_; j < last; ++j) (*field)[at(j)] = (*field)[at(static_cast<long>(folded(*problem_, j)))];
  }
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
  for (long j = 0; j < sites_; ++j) bad += *share(j) > 0 && *now(j) <= limit ? 0u : 1u;
  for (long j = 0; bad != 0 && j < sites_; ++j) {
    if (!(*share(j) > 0))
      fails(j, "the pore pressure has reached the normal stress: the effective normal stress is " + digits(*share(j)) +
                   " of it");
    if (!(*now(j) <= limit))
      fails(j, "contacts have become stronger than the time step allows: a^2 is " + digits(*now(j)) + ", at most " +
                   digits(limit_));
  }
}

void ContactField::save(std::size_t site, double* to) const {
  to[0] = excess_[site];
  to[1] = *before(static_cast<long>(site));
}

void ContactField::resume(std::size_t site, double theta, const double* from) {
  const long j = static_cast<long>(site);
  excess_[site] = from[0];
  before_[at(j)] = from[1];
  advance(j, 0, {&theta, 1}, {&theta, 1});
  now_[at(j)] = *next(j);
}

}  // namespace slipfront::chain
