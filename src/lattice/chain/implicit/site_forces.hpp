#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

#include "friction/state/contacts.hpp"
#include "lattice/chain/events/event_log.hpp"
#include "lattice/chain/implicit/compact_springs.hpp"
#include "lattice/chain/model/blocks.hpp"
#include "slipfront/lattice/chain/problem.hpp"

namespace slipfront::chain {

/// The motion between two implicit steps, and everything else that the next step depends on.
struct ChainState {
  double time = 0;
  long steps = 0;
  double last_step = 0, earlier_step = 0, next_step = 0;
  double window_start = 0;       ///< time at which the present window of ImplicitChain::check_progress began
  std::vector<double> u, v;      ///< like all columns, of the sites of this rank
  std::vector<double> state;     ///< the friction law's state variables, site by site
  std::vector<double> w, slope;  ///< velocity (0 of a held site) and slope of friction in the last step
  std::vector<double> acceleration, earlier;  ///< accelerations of the last step and of the step before it
  std::vector<double> excess;                 ///< p - p_0 of the pores; empty unless contacts change
  std::vector<double> a2;                     ///< follows from the state; empty if a is the same everywhere
  /// Energy supplied, dissipated, and given by contacts, block by block: sums that do not depend on the ranks.
  std::vector<double> flows;
  EventLog log;
  FrontLog fronts;

  /// Visits all members but a2. If `a` writes, all ranks have to call this.
  void archive(Archive& a, const OwnBlocks& own, const Ranks& ranks) {
    a(time, steps, last_step, earlier_step, next_step, window_start);
    for (const double number : {time, last_step, earlier_step, next_step, window_start})
      a.require(std::isfinite(number));
    a.require(steps >= 0);
    for (auto* column : {&u, &v, &state, &w, &slope, &acceleration, &earlier, &excess})
      a.parts(*column, ranks, own.begin, own.size(), own.blocks.sites);
    a.parts(flows, ranks, own.first, own.count, own.blocks.count);
    a(log, fronts);
  }
};

/// sin(y) / y and its derivative.
struct Sinc {
  double value, slope;
};
inline Sinc sinc(double y) {
  const double y2 = y * y;
  if (y2 < 1e-3) return {1 - y2 / 6 * (1 - y2 / 20 * (1 - y2 / 42)), -y / 3 * (1 - y2 / 10 * (1 - y2 / 28))};
  const double s = std::sin(y) / y;
  return {s, (std::cos(y) - s) / y};
}

/// (cos u - cos u') / (u' - u), from their middle and half their difference.
inline double mean_sine(double middle, double half) { return std::sin(middle) * sinc(half).value; }

/// The forces on the sites of a rank of a chain that moves by implicit steps, and how its contacts change. Sites count
/// from the first of the rank on.
class SiteForces {
 public:
  /// (all) Sets the state of friction and the contacts of `now`, whose u and v are those of the start.
  SiteForces(const Problem& problem, ChainState& now, const Ranks& ranks);

  const Problem& problem() const { return problem_; }
  const CompactSprings& springs() const { return springs_; }
  const Ranks& ranks() const { return springs_.ranks(); }
  const OwnBlocks& own() const { return springs_.own(); }
  std::size_t sites() const { return own().size(); }
  double x(std::size_t site) const { return problem_.grid.x(own().begin + site); }
  std::size_t variables() const { return variables_; }  ///< state variables of a site
  bool rubs() const { return rubs_; }                   ///< whether there is friction
  bool contacts_change() const { return contacts_.act(); }
  /// Whether a^2 changes with them: not without a substrate.
  bool has_changing_contacts() const { return !base_.empty(); }

  double contact_squared(const ChainState& m, std::size_t j) const { return m.a2.empty() ? all_contact_ : m.a2[j]; }
  double effective_stress(const ChainState& m, std::size_t j) const {
    return contacts_.act() ? contacts_at(m, j).share(m.excess[j]) : 1;
  }
  /// Stiffness of the spring that loads a site, per length.
  double pull(std::size_t site) const {
    const Loading& l = problem_.loading;
    if (!stiffness_.empty()) return stiffness_[site];
    if (l.where == Pulled::everywhere) return l.stiffness;
    const bool pulled = l.where == Pulled::left ? springs_.at_left_end(site) : springs_.at_right_end(site);
    return pulled ? (1 - share_of_end()) * l.stiffness / springs_.weight(site) : 0;
  }
  /// The share of the stretch of a spring at a pulled end that lies between the end and its site. With 1 + m d2 on the
  /// left side (CompactSprings), a stress on the end displaces its site by 2 m h times the stress less than the end.
  double share_of_end() const {
    const Loading& l = problem_.loading;
    if (l.where == Pulled::everywhere) return 0;
    const double at_end = 2 * springs_.coupling() * springs_.spacing() * l.stiffness;
    return at_end / (1 + at_end);
  }
  /// F(x, t) as the problem has it, and with the pull of the springs.
  double given_forcing(std::size_t j, double time) const { return problem_.forcing ? problem_.forcing(x(j), time) : 0; }
  double forcing(const ChainState& m, std::size_t j) const;
  /// The forces that drive the fixed ends of the chain: F and that of the springs. They are 0 under friction that is
  /// steep at rest, which balances them next to the end already.
  struct Drives {
    double left = 0, right = 0;
  };
  Drives drives_of_ends(double time) const;
  /// Velocity of the far end of the spring at a site.
  double pulled_at(std::size_t site) const { return velocity_.empty() ? problem_.loading.velocity : velocity_[site]; }
  /// Stretch of the spring at a site that is displaced by u.
  double stretch(std::size_t j, double u, double time) const { return pulled_at(j) * time - (u - first_u_[j]); }
  double friction(const ChainState& m, std::size_t j, double velocity) const;
  double loading_energy(const ChainState& m) const;  ///< (all) in the springs that pull

  using State = std::array<double, friction::most_variables>;
  /// The state variables of a site after a time at the velocity p. `values` has room for them.
  std::span<const double> evolved(const ChainState& m, std::size_t j, double p, double time, State& values) const;

  /// State and contact of a site after a step from `m` at the mean velocity p, and 1 - p_pore in its middle. For
  /// friction that changes contacts.
  struct Aged {
    double theta, excess, a2, share;
  };
  Aged aged(const ChainState& m, std::size_t j, double p, double dt) const;
  /// Changes the state and the contact of a site over a step at the mean velocity p.
  void evolve(ChainState& m, std::size_t j, double p, double dt) const;
  /// a^2 from the states of the sites. It is always computed in this way, so a resumed run has the same bits.
  void strengthen_contacts(ChainState& m) const;
  /// \throws NumericsError where the pressure of pores has reached the normal stress.
  void check_contacts(const ChainState& m) const;

  static constexpr double smallest_velocity = 1e-290;  ///< far below that of any interface at rest
  /// A small change of a velocity w, away from rest, for the slope of friction there.
  static double difference(double w) { return std::copysign(std::fmax(1e-6 * std::fabs(w), smallest_velocity), w); }

 private:
  void start_contacts(ChainState& now);
  void place_springs();
  /// The contacts of a site, whose numbers may vary.
  friction::Contacts contacts_at(const ChainState& m, std::size_t j) const {
    if (!problem_.friction.contacts_vary()) return contacts_;
    return problem_.friction.contacts_at(friction::LocalState(m.state).subspan(variables_ * j, variables_));
  }

  Problem problem_;
  std::size_t variables_;
  bool rubs_;
  CompactSprings springs_;
  double all_contact_;           ///< a^2 where it is the same everywhere
  friction::Contacts contacts_;  ///< with the largest of numbers that vary
  std::vector<double> base_;  ///< a^2 of contacts without age and pores without pressure; empty unless contacts change
  std::vector<double> first_u_;
  std::vector<double> stiffness_, velocity_;  ///< the springs have these; empty unless they vary
};

}  // namespace slipfront::chain
