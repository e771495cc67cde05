#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <functional>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "friction/state/contacts.hpp"
#include "lattice/chain/explicit/levels/scheme.hpp"
#include "lattice/chain/explicit/levels/slab.hpp"
#include "slipfront/lattice/chain/problem.hpp"
#include "system/ranks.hpp"

namespace slipfront::chain {

/// The site of the grid that j means. A j past an end is reflected there, or counted around a periodic chain.
std::size_t folded(const Problem& problem, long j);

/// Number of sites by which the arrays of a rank extend past its sites on either side: a halo, up to whole vectors.
inline constexpr std::size_t margin = halo + 2 * lanes;

/// (all) Fills the margins of an array with `columns` numbers for each site of this rank and of its margins, which
/// begin at site `first`. A margin has the sites of the rank next to it. Past an end of the chain it has those that
/// `folded` gives.
void fill_margins(const Problem& problem, const Ranks& ranks, long first, std::size_t columns,
                  std::vector<double>& values);

/// Names of the state variables of a site, in the order of Levels::state. The state variables of the friction law come
/// first. If contacts age or pores dilate, the excess pore pressure and a^2 at the level before follow.
std::vector<std::string> state_names(const Problem& problem);

/// Contacts that change with the state of friction: a^2 of every site at three time levels, and the pressure of its
/// pores. The arrays hold the sites of one rank and its margins, and begin at site `first`.
class ContactField {
 public:
  /// `a2` is a^2 at t = 0.
  ContactField(const Problem& problem, long first, const std::vector<double>& a2);

  bool acts() const { return contacts_.act(); }
  /// Whether pores have a pressure, which then changes friction.
  bool have_pressure() const { return contacts_.dilatancy > 0 || contacts_.ambient > 0; }
  const double* before(long j) const { return before_.data() + at(j); }
  const double* now(long j) const { return now_.data() + at(j); }
  const double* next(long j) const { return next_.data() + at(j); }
  /// 1 - p, from site j on.
  const double* share(long j) const { return share_.data() + at(j); }

  /// (all) Gets the present a^2 of the margins, which the next level needs.
  void exchange(const Ranks& ranks) { fill_margins(*problem_, ranks, first_, 1, now_); }
  /// (all) Gets everything else in the margins, which windows need.
  void exchange_all(const Ranks& ranks);
  /// Computes a^2 and the pore pressure at the next level, for the sites from `first` on. Their theta changed from
  /// `theta_before` to `theta` in a step of length `time`.
  void advance(long first, double time, std::span<const double> theta_before, std::span<const double> theta);
  /// Moves to the next level.
  void proceed();
  /// \throws NumericsError if, at a site of this rank, the pressure of pores has reached the normal stress, or if
  /// contacts have become too strong for the time step.
  void check(double time) const;

  /// How many numbers the state of a site has in addition to theta.
  static constexpr std::size_t columns = 2;
  void save(std::size_t site, double* to) const;
  void resume(std::size_t site, double theta, const double* from);
  /// Call this after all sites are resumed.
  void resumed() { look_ahead(); }

 private:
  std::size_t at(long j) const { return static_cast<std::size_t>(j - first_); }
  long begin() const { return first_ + static_cast<long>(margin); }  ///< first site of this rank
  long end() const { return first_ + static_cast<long>(now_.size() - margin); }
  void look_ahead();

  const Problem* problem_;
  friction::Contacts contacts_;        ///< with the largest of numbers that vary
  friction::VaryingContacts varying_;  ///< those of each site, if numbers of contacts or pores vary
  long first_;
  double limit_ = 0;            ///< largest a^2 for which the time step was chosen
  std::vector<double> base_;    ///< a^2 without ageing and pore pressure
  std::vector<double> excess_;  ///< p - p_0
  std::vector<double> before_, now_, next_, share_;
};

/// A forcing F(x, t) at the sites of a rank, as a sum of at most eight functions of x times weights, which change from
/// level to level. A formula takes a hundred times as long as a site, so where F is smooth in time it is the polynomial
/// through its values at sixteen times, over as many levels as that is right to 1e-13 of its largest value. Each of
/// these levels is compared with the formula, at other sites than the level before, so that most sites are compared
/// once. The functions of x are rows of these values, from a decomposition with complete pivoting: sin(x - t) needs
/// two. Where no polynomial is right, the formula is called at each level, and they are F at three levels.
class ForcingInTime {
 public:
  ForcingInTime() = default;
  /// `x` are the positions of the sites.
  ForcingInTime(std::function<double(double x, double t)> forcing, std::vector<double> x, double dt)
      : forcing_(std::move(forcing)), x_(std::move(x)), dt_(dt) {}

  /// (all) Finds F at a level >= 0, the level before and some levels after it. It does not depend on the levels that
  /// were asked for before. F need not be defined before the start, so there it is extrapolated.
  void at(long level, const Ranks& ranks);
  /// How many levels after that F is known.
  std::size_t reach() const { return weights_.size() - 2; }
  const ForceTerms::Weights& weights(long levels_after) const {
    return weights_[static_cast<std::size_t>(levels_after + 1)];
  }
  ForceTerms terms(std::size_t site) const;
  /// F at a site, so many levels after.
  double operator()(std::size_t site, long levels_after) const;

 private:
  static constexpr std::size_t nodes = 16;
  static constexpr long longest = 16384, shortest = 64;  ///< levels of a polynomial
  using NodeWeights = std::array<double, nodes>;

  double formula(std::size_t site, double level) const { return forcing_(x_[site], level * dt_); }
  void choose_levels(long begin, long end);
  NodeWeights of_nodes(double level) const;
  ForceTerms::Weights of_terms(double level) const;
  void call_formula(long level);
  void choose(long level, const Ranks& ranks);
  /// (all) Whether the polynomial from level begin_ - 2 to end_ is right.
  bool fits(const Ranks& ranks);
  double largest_error(long level, std::size_t first) const;
  void fill(std::size_t stride);
  /// (all) Whether ForceTerms::most terms are enough.
  bool decompose(const Ranks& ranks);
  void resize_terms(std::size_t count);
  /// Sites between those that are compared at a level.
  std::size_t apart() const { return static_cast<std::size_t>(std::min(end_ - begin_, 1024L)); }

  std::function<double(double, double)> forcing_;
  std::vector<double> x_;
  double dt_ = 0;
  long begin_ = 0, end_ = 0;  ///< levels of the present polynomial, or of the present calls of the formula
  bool polynomial_ = false;
  long called_ = -1;                             ///< the level around which the terms are calls of the formula
  double most_ = 0;                              ///< largest |F| at the nodes, of all ranks
  NodeWeights level_of_node_{}, barycentric_{};  ///< barycentric_: those of the nodes in the barycentric formula
  std::array<std::vector<double>, nodes> values_;
  std::vector<NodeWeights> nodes_of_terms_;  ///< weights of a term in the values at the nodes
  std::vector<Aligned> terms_;
  std::vector<ForceTerms::Weights> weights_;  ///< weights of the terms, at each level from the one before on
};

/// Sites [left, right) whose next level is computed, as indices of arrays that begin at site `offset` of the chain. The
/// arrays have a vector more on either side of them.
struct LevelSites {
  long offset;
  std::size_t left, right;
  const double *before, *now;
  double *next, *y;                      ///< `next` may be `before`, unless friction has an implicit speed
  long ahead = 0;                        ///< levels after the present one of the forces
  const double* coefficients = nullptr;  ///< contact_coefficients, if a varies
  friction::LocalStates states = {};
  double* applied = nullptr;  ///< gets the friction force on each site, if it is steep at rest
  StepOfU step = {};
};

/// All forces on the sites of a rank.
class Forces {
 public:
  /// The forces on sites [begin, end) and on some more on either side. These continue around a periodic chain, and are
  /// reflected at the ends of other chains.
  Forces(const Problem& problem, const Scheme& scheme, const Ranks& ranks, long level, std::size_t begin,
         std::size_t end);

  /// The largest number of levels by which a site may be ahead of others.
  std::size_t reach() const {
    if (contacts_.acts()) return 1;
    return steady() ? halo : forcing_.reach();
  }
  /// Whether friction has an implicit speed, so that a next level needs the two before it.
  bool implicit_speed() const { return nonlinear_ && !problem_.friction.constant_strength(); }
  /// Whether a differs from 1 or changes.
  bool has_contact() const { return !a2_.empty(); }
  /// a(x)^2 from site j on; null if it is 1 everywhere.
  const double* a2(long j) const {
    return contacts_.acts() ? contacts_.now(j) : a2_.empty() ? nullptr : a2_.data() + at(j);
  }
  /// Contacts that change with the state of friction.
  const ContactField& contacts() const { return contacts_; }
  /// Whether F is absent or does not change.
  bool steady() const { return steady_; }
  /// F from site j on, if it does not change; and F if it does, as the sum of `weights` times terms.
  const double* steady_F(long j) const { return steady_F_.data() + at(j); }
  ForceTerms terms(long j) const { return forcing_.terms(at(j)); }
  const ForceTerms::Weights& weights(long ahead) const { return forcing_.weights(ahead); }
  /// F at site j at the present level, and its rate of change. Both are 0 without forcing.
  double now(long j) const { return !problem_.forcing ? 0.0 : steady_ ? steady_F_[at(j)] : forcing_(at(j), 0); }
  double rate(long j) const { return steady_ ? 0.0 : (forcing_(at(j), 1) - forcing_(at(j), -1)) / (2 * dt_); }

  /// Computes the part of the next level that depends on the site, on whole vectors [begin, end), and measures the step
  /// to this level.
  void local_part(const LevelSites& sites, std::size_t begin, std::size_t end) const;
  /// Computes the next level but for the load and friction that is not linear, which `add_load_and_friction` adds.
  void begin_level(const EndConditions& ends, const LevelSites& sites, Outflow& outflow) const;
  void add_load_and_friction(const EndConditions& ends, const LevelSites& sites) const;
  /// The coefficients for indices [begin, end) of arrays that begin at site `offset`, if a varies; and those of the
  /// next level, if contacts change.
  void contact_coefficients(long offset, std::size_t begin, std::size_t end, double* coefficients) const;
  void next_coefficients(long offset, std::size_t begin, std::size_t end, double* coefficients) const;
  /// Computes u from z, both in turns, on indices [begin, end).
  void displacements(const double* coefficients, const double* z, double* u, std::size_t begin, std::size_t end) const {
    chain::displacements(scheme_.rule.f, scheme_.eps, coefficients, z, u, begin, end);
  }
  double eps() const { return scheme_.eps; }
  /// The force of the substrate as a function of u.
  const PeriodicForce& sine() const { return sine_; }
  const Scheme& scheme() const { return scheme_; }
  bool phases_of_32_bits() const { return problem_.phases_of_32_bits; }
  /// Energies, divided by the spacing, that contacts give to the substrate at `size` sites from site j on. The step D
  /// ends at u.
  void energies_of_contacts(long j, std::size_t size, const double* u, const double* D, double* energies) const {
    chain::energies_of_contacts(sine_, contacts_.now(j), contacts_.next(j), u, D, energies, size);
  }
  /// (all) Gets what a level needs from the sites next to those of this rank.
  void exchange(const Ranks& ranks);
  /// (all) Gets everything of these sites, which windows need.
  void exchange_all(const Ranks& ranks);
  /// (all) Moves on by at most `reach` levels.
  void proceed(std::size_t levels, const Ranks& ranks);
  /// The state variables of sites from j on, `variables` for each.
  double* state_of(long j) { return state_.data() + variables_ * at(j); }
  const double* state_of(long j) const { return state_.data() + variables_ * at(j); }
  std::size_t variables() const { return variables_; }
  /// Whether the first `evolving` of them change.
  bool ages() const { return problem_.friction.state_evolves(); }
  std::size_t evolving() const { return problem_.friction.definition().state.size(); }
  /// Advances the state variables of `size` sites from site `first` on by the step from `now` to `next`.
  void age(long first, std::size_t size, const double* now, const double* next, friction::EvolvingStates states);
  /// The state variables of sites [begin, end), site by site. Most laws have none.
  std::vector<double> states(std::size_t begin, std::size_t end) const;
  void set_states(std::size_t begin, const std::vector<double>& states);
  /// How many numbers the state of a site has.
  std::size_t state_size() const { return variables_ + (contacts_.acts() ? ContactField::columns : 0); }
  /// Call this when the states of all sites are set.
  void resumed() {
    if (contacts_.acts()) contacts_.resumed();
  }

  /// The friction force on site j at velocity u_t.
  double friction(long j, double velocity) const {
    return (contacts_.acts() ? *contacts_.share(j) : 1.0) * problem_.friction.force(velocity, state(j));
  }

 private:
  friction::LocalState state(long j) const {
    return variables_ == 0 ? friction::LocalState{} : friction::LocalState{state_of(j), variables_};
  }
  std::size_t at(long j) const { return static_cast<std::size_t>(j - first_); }
  struct Range {
    std::size_t begin, end;
  };
  static Range range_of(const EndConditions& ends, const LevelSites& sites);
  Range shortened_at_once(const EndConditions& ends, const Range& all) const;
  /// The longest step (turns) that Coulomb friction stops.
  double longest_hold() const;
  void add_load(const LevelSites& sites, std::size_t begin, std::size_t end) const;
  void add_friction(const LevelSites& sites, std::size_t begin, std::size_t end) const;
  void age_contacts(long first, std::size_t size, const double* velocity, friction::EvolvingStates states);

  Problem problem_;
  Scheme scheme_;
  PeriodicForce sine_;
  double dt_;
  long level_;
  long first_, last_;          ///< the arrays hold sites [first_, last_)
  bool nonlinear_;             ///< there is friction other than C w, which the scheme itself contains
  std::size_t variables_;      ///< number of state variables of the friction law
  std::vector<double> state_;  ///< their values at each site
  std::vector<double> a2_;     ///< a^2; at t = 0 if it changes
  ContactField contacts_;
  ForcingInTime forcing_;
  bool steady_;
  std::vector<double> steady_F_, steady_drive_;  ///< a force that does not change, and its effect on each level
};

}  // namespace slipfront::chain
