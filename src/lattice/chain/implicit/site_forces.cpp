#include "lattice/chain/implicit/site_forces.hpp"

#include <algorithm>
#include <cmath>

#include "math/digits.hpp"
#include "slipfront/error.hpp"

namespace slipfront::chain {

SiteForces::SiteForces(const Problem& p, ChainState& now, const Ranks& ranks)
    : problem_(p),
      variables_(p.friction.state_size()),
      rubs_(p.friction.acts()),
      springs_(p, now.u, ranks),
      all_contact_(p.substrate ? 1 : 0),
      contacts_(p.friction.contacts()),
      first_u_(now.u) {
  now.state.resize(variables_ * sites());
  for (std::size_t j = 0; variables_ > 0 && j < sites(); ++j)
    p.friction.start(x(j), 0, std::span(now.state).subspan(variables_ * j, variables_));
  start_contacts(now);
  place_springs();
}

void SiteForces::place_springs() {
  const Loading& l = problem_.loading;
  for (std::size_t j = 0; l.stiffness_at && j < sites(); ++j) stiffness_.push_back(l.stiffness_at(x(j)));
  for (std::size_t j = 0; l.velocity_at && j < sites(); ++j) velocity_.push_back(l.velocity_at(x(j)));
}

void SiteForces::start_contacts(ChainState& now) {
  const Problem& p = problem_;
  if (contacts_.act()) now.excess.assign(sites(), 0);
  if (!(p.contact || contacts_.act()) || !p.substrate) return;
  for (std::size_t j = 0; j < sites(); ++j) {
    const double a = p.contact ? p.contact(x(j)) : 1;
    now.a2.push_back(a * a);
  }
  if (!contacts_.act()) return;
  for (std::size_t j = 0; j < sites(); ++j)
    base_.push_back(now.a2[j] / contacts_at(now, j).strength(now.state[variables_ * j], 0));
  strengthen_contacts(now);
}

void SiteForces::strengthen_contacts(ChainState& m) const {
  for (std::size_t j = 0; j < base_.size(); ++j)
    m.a2[j] = base_[j] * contacts_at(m, j).strength(m.state[variables_ * j], m.excess[j]);
}

double SiteForces::forcing(const ChainState& m, std::size_t j) const {
  return given_forcing(j, m.time) + pull(j) * stretch(j, m.u[j], m.time);
}

SiteForces::Drives SiteForces::drives_of_ends(double time) const {
  const Problem& p = problem_;
  if (!springs_.holds_an_end() || p.friction.steep_at_rest()) return {};
  const auto at = [&](double x) {
    const Loading& l = p.loading;
    const double pulled = l.where == Pulled::everywhere ? l.stiffness_of(x) * l.velocity_of(x) * time : 0;
    return (p.forcing ? p.forcing(x, time) : 0) + pulled;
  };
  return {at(p.grid.x(0)), at(p.grid.x(p.grid.sites - 1))};
}

double SiteForces::friction(const ChainState& m, std::size_t j, double velocity) const {
  const double force =
      problem_.friction.force(velocity, friction::LocalState(m.state).subspan(variables_ * j, variables_));
  return contacts_.act() ? effective_stress(m, j) * force : force;
}

double SiteForces::loading_energy(const ChainState& m) const {
  if (!problem_.loading.acts()) return 0;
  return own().sum(ranks(), [&](std::size_t j) {
    const double by = stretch(j, m.u[j], m.time);
    return springs_.weight(j) * pull(j) * by * by / 2;
  });
}

std::span<const double> SiteForces::evolved(const ChainState& m, std::size_t j, double p, double time,
                                            State& values) const {
  const std::span<double> state(values.data(), variables_);
  if (variables_ == 0) return state;
  std::copy_n(&m.state[variables_ * j], variables_, values.begin());
  problem_.friction.evolution().advance(friction::Slip::at(p), time, state);
  return state;
}

SiteForces::Aged SiteForces::aged(const ChainState& m, std::size_t j, double p, double dt) const {
  const friction::Contacts contacts = contacts_at(m, j);
  const double theta = m.state[variables_ * j], excess = m.excess[j];
  State middle, end;
  evolved(m, j, p, dt / 2, middle);
  evolved(m, j, p, dt, end);
  const double after = contacts.excess_after(dt, excess, theta, end[0]);
  return {end[0], after, base_.empty() ? 0 : base_[j] * contacts.strength(end[0], after),
          contacts.share(contacts.excess_after(dt / 2, excess, theta, middle[0]))};
}

void SiteForces::evolve(ChainState& m, std::size_t j, double p, double dt) const {
  if (!contacts_.act()) {
    State values;
    const std::span<const double> end = evolved(m, j, p, dt, values);
    std::copy(end.begin(), end.end(), m.state.begin() + static_cast<std::ptrdiff_t>(variables_ * j));
    return;
  }
  const Aged then = aged(m, j, p, dt);
  m.state[variables_ * j] = then.theta;
  m.excess[j] = then.excess;
  if (!base_.empty()) m.a2[j] = then.a2;
}

void SiteForces::check_contacts(const ChainState& m) const {
  for (std::size_t j = 0; j < sites(); ++j)
    if (!(effective_stress(m, j) > 0))
      throw NumericsError("t = " + digits(m.time) + ": at x = " + digits(x(j)) +
                          " the pore pressure has reached the normal stress: the effective normal stress is " +
                          digits(effective_stress(m, j)) + " of it");
}

}  // namespace slipfront::chain
