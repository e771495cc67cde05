#pragma once

#include <cstddef>
#include <span>
#include <string_view>
#include <vector>

#include "friction/state/contacts.hpp"
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
  friction::Contacts contacts_;         ///< with the largest of numbers that vary
  std::vector<friction::Contacts> at_;  ///< those of each site, if numbers of contacts or pores vary
  long first_;
  double limit_ = 0;            ///< largest a^2 for which the time step was chosen
  std::vector<double> base_;    ///< a^2 without ageing and pore pressure
  std::vector<double> excess_;  ///< p - p_0
  std::vector<double> before_, now_, next_, share_;
};

}  // namespace slipfront::chain
