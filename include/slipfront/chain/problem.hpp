#pragma once
/// \file
/// What a chain run is given: Eqs. 1 and 3 in the units of docs/theory.md 1,
///     u_tt - u_xx + a(x)^2 sin u = F(x, t) - f(u_t).

#include <cstddef>
#include <functional>
#include <vector>

#include "slipfront/friction/friction.hpp"

namespace slipfront::chain {

/// The spacing of a grid unless another is given, in widths of a dislocation. At 0.5 the grid pins slow dislocations
/// (docs/chain.md, "The barrier of the grid").
inline constexpr double default_spacing = 0.4;

/// Evenly spaced sites: x = left + j spacing, j = 0 ... sites - 1, in b / A.
struct Grid {
  double left = 0;
  double spacing = default_spacing;
  std::size_t sites = 0;

  double x(std::size_t j) const { return left + static_cast<double>(j) * spacing; }
};

/// Displacement and velocity of every site at one time, in b / 2 pi and c A / 2 pi (u and u_t of Eq. 3).
struct Motion {
  std::vector<double> u;
  std::vector<double> velocity;  ///< empty: at rest
};

/// The motion of sites [begin, end), for chains that no process holds whole. Explicit chains ask for some 65 536 sites
/// at a time, on each rank for its own sites and a few next to them.
using MotionOf = std::function<Motion(std::size_t begin, std::size_t end)>;

enum class Model {
  sine_gordon,  ///< Eq. 3, on a grid chosen by accuracy
  lattice,      ///< Eq. 1: a site at every asperity, spacing A; discreteness is real
};

enum class End {
  free,       ///< u_x = 0
  fixed,      ///< u stays
  absorbing,  ///< waves leave and do not come back; outside is a train at rest (Boundary::left_stress), or none
};

struct Boundary {
  End left = End::free, right = End::free;
  bool periodic = false;                     ///< the ends above do not count then
  long charge = 0;                           ///< of a periodic chain: u falls by 2 pi charge once around
  double left_stress = 0, right_stress = 0;  ///< of the trains outside absorbing ends
};

/// Which sites are pulled by springs.
enum class Pulled { everywhere, left, right };

/// Springs whose far ends move at a constant velocity: F = stiffness (velocity t - slip), slip = u less u at t = 0.
struct Loading {
  double stiffness = 0;  ///< > 0: force over slip; of a pulled end, stress over slip. 0: no springs
  double velocity = 0;   ///< in c A / 2 pi
  Pulled where = Pulled::everywhere;
  double event_velocity = 0;  ///< above which a part of the chain takes part in an event; 0: no events are recorded

  bool acts() const { return stiffness > 0; }
};

struct Problem {
  Grid grid;
  Model model = Model::sine_gordon;
  Boundary boundary;
  friction::Friction friction;                        ///< the closure does not matter here
  std::function<double(double x, double t)> forcing;  ///< F, t >= 0; null: none. Called from one thread only
  bool steady_forcing = false;                        ///< F does not depend on t: it is asked for at t = 0 only
  std::function<double(double x)> contact;            ///< a > 0 at t = 0; null: 1. Called from one thread only
  double longest = 0;  ///< time for which contacts may grow stronger, if they change with the state of friction
  /// Largest stress of trains of dislocations that may run into trains of antidislocations, or through each other: the
  /// chosen step is shorter for it. 0: none will.
  double crossing_stress = 0;
  double step = 0;  ///< dt; 0: chosen. The fourth order of sine_gordon holds for the chosen one only
  Loading loading = {};
  bool substrate = true;    ///< false: a = 0, sites on a smooth surface; implicit steps only
  bool implicit = false;    ///< implicit steps of any length (docs/loading.md); `step` is ignored then
  double tolerance = 5e-5;  ///< of an implicit step: error of u in radians, of u_t in c A / 2 pi, of ln(theta)
};

/// The coarsest grid that is accepted: sites in a width (b / A over a, Lorentz contraction apart) of a dislocation.
inline constexpr double least_sites_per_width = 1.5;

/// The step that `step = 0` chooses: of sine_gordon close to the spacing, of a lattice 0.05 or less.
double chosen_step(const Problem& problem);

/// Bytes that a run holds, all ranks together.
double memory_needed(const Problem& problem);

/// \throws InputError for numbers out of range, a grid too coarse for a dislocation, an unstable step, or if the
/// machine, which holds `share_of_machine` of the chain (Ranks), has too little memory. Allocates nothing.
void check(const Problem& problem, double share_of_machine = 1);

}  // namespace slipfront::chain
