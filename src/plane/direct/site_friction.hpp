#pragma once
/// \file
/// Friction on the sites, with its state, and the absorbing edges, which are dashpots of the impedance of waves.

#include <utility>
#include <vector>

#include "plane/direct/rows.hpp"
#include "plane/direct/sites.hpp"

namespace slipfront::plane {

/// The work against friction and against absorbing edges in one step of a row, per area of a site.
struct Rubbed {
  double dissipated = 0, radiated = 0;
};

class SiteFriction {
 public:
  SiteFriction(const Problem& problem, const Sites& sites, double dt);

  /// Whether friction is viscous, so that `slow` needs `rates`.
  bool is_viscous() const { return !sites_.viscous.empty(); }
  /// Whether there is any friction.
  bool acts() const { return is_viscous() || friction_.acts(); }
  /// Slows a step of row j from u(t - dt), `before`, to u(t + dt), `after`. `began`: whether nucleation has begun. The
  /// force is that of D = (after - before) / (2 dt): for f = C w this is of fourth order, because the terms of v_t in
  /// u_t = D - dt^2 / 6 v_t and in dt^2 / 12 (v - f)_tt cancel. The work of f = C w is that
  /// of u_t to fourth order, and the work of another law that of D.
  Rubbed slow(std::size_t j, bool began, const Rates& rates, const double* before, double* after) const;
  /// Changes the states of row j by the slip from `now` to `after`.
  void age(std::size_t j, const double* now, const double* after);
  /// Reduces the acceleration of row j at rest by the strength of friction, at t = 0.
  void resist(std::size_t j, bool began, double* acceleration) const;

  const std::vector<double>& states() const { return states_; }
  /// Replaces the states by equally many.
  void set_states(std::vector<double> values) { states_ = std::move(values); }

 private:
  double absorb(std::size_t j, const double* before, double* after) const;
  double rub_by_law(std::size_t j, bool began, const double* before, double* after) const;
  friction::LocalStates states_of(std::size_t j) const { return {states_.data() + j * sites_.nx * each_, each_}; }

  const Problem& problem_;
  const Sites& sites_;
  double dt_;
  friction::Friction friction_;  ///< stretched; none if it is viscous
  std::size_t each_;             ///< states of a site
  std::vector<double> states_;   ///< row by row of the band, without ghosts
  std::vector<char> patch_;      ///< sites of the nucleation patch, if friction holds the state
};

}  // namespace slipfront::plane
