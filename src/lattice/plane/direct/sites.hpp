#pragma once
/// \file
/// The sites of the direct solver and what acts on each. Lengths and times are stretched by the scale.
/// The forces on the sites that do not depend on their motion: F, and the static load that holds the initial state.
/// Friction on the sites, with its state, and the absorbing edges, which are dashpots of the impedance of waves.
/// The dislocation lines of a state of all sites: the contours u = pi, 3 pi, 5 pi, ...

#include <cstddef>
#include <utility>
#include <vector>

#include "lattice/plane/direct/rows.hpp"
#include "slipfront/lattice/plane/problem.hpp"

namespace slipfront::plane {

/// The sites of a rank: all columns, and a band of rows. Arrays have two ghost sites at each side of each row, and four
/// ghost rows below and above. Ghosts mirror the sites inside the domain, or are the rows of the neighbouring ranks.
struct Sites {
  static constexpr std::size_t ghosts = 2, ghost_rows = 4;
  std::size_t nx = 0, ny = 0;
  std::size_t first_row = 0, all_rows = 0;  ///< the first row of the band, and the number of rows of the domain
  double scale = 1;
  double left = 0, bottom = 0;  ///< edges of the domain, in units of the scenario
  double hx = 0, hy = 0;        ///< spacings, stretched

  std::vector<double> contact2;  ///< a^2; empty: 1
  std::vector<double> viscous;   ///< C / scale; empty: none
  std::vector<double> moves;     ///< 1, or 0 where the interface is held; empty: 1

  std::size_t stride() const { return nx + 2 * ghosts; }
  std::size_t size() const { return stride() * (ny + 2 * ghost_rows); }
  std::size_t at(std::size_t i, std::size_t j) const { return (j + ghost_rows) * stride() + i + ghosts; }
  /// The first site of a row of the band, or of a ghost row.
  std::size_t start_of(std::ptrdiff_t row) const {
    return static_cast<std::size_t>(row + static_cast<std::ptrdiff_t>(ghost_rows)) * stride() + ghosts;
  }
  double x(std::size_t i) const { return left + (static_cast<double>(i) + 0.5) * hx / scale; }
  double y(std::size_t j) const { return y_of(first_row + j); }
  double y_of(std::size_t row_of_domain) const {
    return bottom + (static_cast<double>(row_of_domain) + 0.5) * hy / scale;
  }

  bool has_bottom() const { return first_row == 0; }
  bool has_top() const { return first_row + ny == all_rows; }
  /// Whether a row of the band, or a ghost row, is next to an edge of the domain.
  bool on_edge(std::ptrdiff_t row) const {
    const std::ptrdiff_t of_domain = row + static_cast<std::ptrdiff_t>(first_row);
    return of_domain == 0 || of_domain + 1 == static_cast<std::ptrdiff_t>(all_rows);
  }
  /// Calls each(at, x, y) for the sites of the band, and for those of ghost rows that lie inside the domain.
  template <class Each>
  void for_each_in_reach(const Each& each) const {
    for (std::size_t row = 0; row < ny + 2 * ghost_rows; ++row) {
      const std::size_t shifted = first_row + row;
      if (shifted < ghost_rows || shifted >= all_rows + ghost_rows) continue;
      for (std::size_t i = 0; i < nx; ++i) each(row * stride() + ghosts + i, x(i), y_of(shifted - ghost_rows));
    }
  }
};

/// Numbers of sites along x and y that are at most `spacing` widths of a dislocation apart. \throws InputError for
/// numbers out of range.
struct Counts {
  double nx, ny;
};
Counts count_sites(const Problem& problem, double scale, double spacing);

/// One of several equal bands of rows.
struct Band {
  int number = 0, bands = 1;
};

/// The sites of a band of a problem, at most `spacing` widths of a dislocation apart. \throws InputError for numbers
/// out of range.
Sites make_sites(const Problem& problem, double scale, double spacing, Band band = {});

/// The sites of the same problem with so many more rows below and above, as far as the domain reaches.
Sites widened(const Problem& problem, const Sites& sites, std::size_t rows);

/// Lines at rest whose mean is the initial slip: at each site the train whose density is the gradient of the slip.
struct Start {
  std::vector<double> u;
  double largest_density = 0;  ///< largest gradient of the slip in the band, in local units
};
/// \throws InputError for a slip that is negative or not finite.
Start lines_at_rest(const Problem& problem, const Sites& sites);

/// Whether each site lies in the nucleation patch; empty if there is none.
std::vector<char> patch_of(const Problem& problem, const Sites& sites);

class Loads {
 public:
  Loads(const Problem& problem, const Sites& sites);
  /// Sets the static load, which is the opposite of the acceleration of each site at t = 0 without it.
  void hold(const std::vector<double>& acceleration);
  /// Finds the forces at a time, in units of the scenario.
  void find(double time);
  /// The force on each site, stretched; empty: none.
  const std::vector<double>& force() const { return force_; }

 private:
  const Problem& problem_;
  const Sites& sites_;
  std::vector<char> patch_;
  std::vector<double> held_, force_;
  bool is_known_ = false;  ///< whether `force_` is that of the last time, and `released_` of the patch
  bool released_ = false;
};

/// The work against friction and against absorbing edges in one step of a row, per area of a site.
struct FrictionWork {
  double dissipated = 0, radiated = 0;
};

/// Consecutive sites of a row, so few that what a step has of them stays in the nearest cache.
struct RowPart {
  static constexpr std::size_t most = 256;
  std::size_t row, begin, size;
};

class SiteFriction {
 public:
  SiteFriction(const Problem& problem, const Sites& sites, double dt);

  /// Whether friction is viscous, so that `slow` needs `rates`.
  bool is_viscous() const { return !sites_.viscous.empty(); }
  /// Whether there is any friction.
  bool acts() const { return is_viscous() || friction_.acts(); }
  /// Slows a step of a part of a row from u(t - dt), `before`, to u(t + dt), `after`. `began`: whether nucleation has
  /// begun. The force is that of D = (after - before) / (2 dt): for f = C w this is of fourth order, because the terms
  /// of v_t in u_t = D - dt^2 / 6 v_t and in dt^2 / 12 (v - f)_tt cancel. The work of f = C w is that of u_t to fourth
  /// order, and the work of another law that of D.
  FrictionWork slow(const RowPart& part, bool began, const Rates& rates, const double* before, double* after) const;
  /// Changes the states of row j by the slip from `now` to `after`.
  void age(std::size_t j, const double* now, const double* after);
  /// Reduces the acceleration of row j at rest by the strength of friction, at t = 0.
  void resist(std::size_t j, bool began, double* acceleration) const;

  const std::vector<double>& states() const { return states_; }
  /// Replaces the states by equally many.
  void set_states(std::vector<double> values) { states_ = std::move(values); }

 private:
  double absorb(const RowPart& part, const double* before, double* after) const;
  double rub_by_law(const RowPart& part, bool began, const double* before, double* after) const;
  friction::LocalStates states_of(std::size_t row, std::size_t i) const {
    return {states_.data() + (row * sites_.nx + i) * each_, each_};
  }

  const Problem& problem_;
  const Sites& sites_;
  double dt_;
  friction::Friction friction_;  ///< stretched; none if it is viscous
  std::size_t each_;             ///< states of a site
  std::vector<double> states_;   ///< row by row of the band, without ghosts
  std::vector<char> patch_;      ///< sites of the nucleation patch, if friction holds the state
};

/// The lines of the stretched displacement `u`, as marching squares with linear interpolation between sites.
/// Every so many crossings between sites become a point: by default every third, because crossings are about a third of
/// a width apart.
std::vector<Line> lines_of(const std::vector<double>& u, const Sites& sites, int crossings_a_point = 3);

}  // namespace slipfront::plane
