#pragma once

#include <cstddef>
#include <span>
#include <string_view>
#include <vector>

#include "friction/state/contacts.hpp"
#include "slipfront/chain/problem.hpp"

namespace slipfront::chain {

/// Site j of the problem's grid, also past its ends.
std::size_t folded(const Problem& problem, long j);

/// Names of the state variables of a site, in the order of Levels::state: those of the friction law, and where contacts
/// age or pores dilate the pressure above the ambient one, and a^2 at the level before.
std::vector<std::string_view> state_names(const Problem& problem);

/// a^2 of sites whose contacts change with the state of friction, at three levels of explicit steps, and the pressure
/// of their pores. Arrays reach from site `first` to `last`, past the ends of the chain too.
class ContactField {
 public:
  /// `a2` is that at t = 0.
  ContactField(const Problem& problem, long first, const std::vector<double>& a2);

  bool acts() const { return contacts_.act(); }
  /// Whether pores have a pressure, and so a say in friction.
  bool have_pressure() const { return contacts_.dilatancy > 0 || contacts_.ambient > 0; }
  const double* before(long j) const { return before_.data() + at(j); }
  const double* now(long j) const { return now_.data() + at(j); }
  const double* next(long j) const { return next_.data() + at(j); }
  /// 1 - p from site j on.
  const double* share(long j) const { return share_.data() + at(j); }

  /// Of sites from `first` on at the next level, where theta has changed.
  void advance(long first, double time, std::span<const double> theta_before, std::span<const double> theta);
  /// To the next level.
  void proceed();
  /// \throws NumericsError where the pressure of pores has reached the normal stress, or contacts have become stronger
  /// than what the time step allows.
  void check(double time) const;

  /// Numbers in the state of a site besides theta.
  static constexpr std::size_t columns = 2;
  void save(std::size_t site, double* to) const;
  void resume(std::size_t site, double theta, const double* from);
  /// After all sites are resumed.
  void resumed() { look_ahead(); }

 private:
  std::size_t at(long j) const { return static_cast<std::size_t>(j - first_); }
  void look_ahead();

  const Problem* problem_;
  friction::Contacts contacts_;
  long first_, sites_;
  double limit_ = 0;            ///< of a^2
  std::vector<double> base_;    ///< a^2 of contacts without age and pores without pressure, of the chain's sites
  std::vector<double> excess_;  ///< p - p_0
  std::vector<double> before_, now_, next_, share_;
};

}  // namespace slipfront::chain
