#pragma once
/// \file
/// The problem that a chain run solves: Eqs. 1 and 3 in the units of docs/theory/1_chain.md,
///     u_tt - u_xx + a(x)^2 sin u = F(x, t) - f(u_t).

#include <cstddef>
#include <functional>
#include <vector>

#include "slipfront/friction/friction.hpp"

namespace slipfront::chain {

/// Default spacing of the grid, in widths of a dislocation. A spacing of 0.5 pins slow dislocations (docs/chain.md,
/// "The barrier of the grid").
inline constexpr double default_spacing = 0.4;

/// Evenly spaced sites at x = left + j spacing, j = 0 ... sites - 1, in b / A.
struct Grid {
  double left = 0;
  double spacing = default_spacing;
  std::size_t sites = 0;

  double x(std::size_t j) const { return left + static_cast<double>(j) * spacing; }
};

/// Displacement u and velocity u_t (Eq. 3) of every site at one time, in b / 2 pi and c A / 2 pi.
struct Motion {
  std::vector<double> u;
  std::vector<double> velocity;  ///< empty if all sites are at rest
};

/// Returns the motion of sites [begin, end), so that no process has to store the whole chain. Explicit chains request
/// some 65 536 sites at a time. Each rank requests its own sites and a few next to them.
using MotionOf = std::function<Motion(std::size_t begin, std::size_t end)>;

enum class Model {
  sine_gordon,  ///< Eq. 3, on a grid chosen by accuracy
  lattice,      ///< Eq. 1, with a site at every asperity; the spacing is A, and its effects are physical
};

enum class End {
  free,       ///< u_x = 0
  fixed,      ///< u is constant
  absorbing,  ///< waves leave without reflection; outside is a train at rest (Boundary::left_stress) or nothing
};

struct Boundary {
  End left = End::free, right = End::free;
  bool periodic = false;                     ///< if true, `left` and `right` are ignored
  long charge = 0;                           ///< periodic chain: u falls by 2 pi charge once around it
  double left_stress = 0, right_stress = 0;  ///< stress of the trains outside absorbing ends
};

/// The sites that the springs pull: all, or the one at an end.
enum class Pulled { everywhere, left, right };

/// Springs that load the chain. Their far ends move at a constant velocity, so F = stiffness (velocity t - slip). The
/// slip is u minus u at t = 0.
struct Loading {
  double stiffness = 0;  ///< force over slip, the largest if it varies; stress over slip at a pulled end; 0: no springs
  double velocity = 0;   ///< in c A / 2 pi; the largest, forward or backward, if it varies
  Pulled where = Pulled::everywhere;
  double event_velocity = 0;  ///< a part of the chain that is faster belongs to an event; 0: record no events
  std::size_t fronts = 0;     ///< positions at which the arrival of each event is recorded
  /// Both at x, if they vary along a chain that is pulled everywhere; null: they do not. Called from one thread only.
  std::function<double(double x)> stiffness_at = {}, velocity_at = {};

  bool acts() const { return stiffness > 0; }
  double stiffness_of(double x) const { return stiffness_at ? stiffness_at(x) : stiffness; }
  double velocity_of(double x) const { return velocity_at ? velocity_at(x) : velocity; }
};

struct Problem {
  Grid grid;
  Model model = Model::sine_gordon;
  Boundary boundary;
  friction::Friction friction;                        ///< its closure is not used here
  std::function<double(double x, double t)> forcing;  ///< F for t >= 0; null: none. Called from one thread only
  bool steady_forcing = false;                        ///< F does not depend on t, and is evaluated at t = 0 only
  std::function<double(double x)> contact;            ///< a > 0 at t = 0; null: 1. Called from one thread only
  double longest = 0;  ///< longest time for which contacts strengthen, if they change with the state of friction
  /// Largest stress of trains that may meet antidislocations, or pass through each other. The chosen step is shorter
  /// for a larger value. 0 means that this does not happen.
  double crossing_stress = 0;
  double step = 0;  ///< dt; 0: chosen_step. Only with the chosen step is sine_gordon of fourth order
  Loading loading = {};
  /// Explicit steps with phases of 32 bits (docs/chain.md), without friction or with viscous friction only.
  bool phases_of_32_bits = false;
  bool substrate = true;    ///< false: a smooth surface, a = 0; needs implicit steps
  bool implicit = false;    ///< take implicit steps of any length (docs/loading.md) and ignore `step`
  double tolerance = 5e-5;  ///< largest error of an implicit step: u in radians, u_t in c A / 2 pi, ln(theta)
};

/// The coarsest grid that we accept, in sites for each width of a dislocation. The width is b / (A a) without Lorentz
/// contraction.
inline constexpr double least_sites_per_width = 1.5;

/// The time step of the problem. With `step = 0` it is close to the spacing for sine_gordon, and 0.05 or less for a
/// lattice.
double chosen_step(const Problem& problem);

/// The largest a that contacts have at t = 0, or can reach by `longest`. \throws InputError unless a > 0.
double largest_contact(const Problem& problem);

/// Bytes of memory that a run needs on all ranks together.
double memory_needed(const Problem& problem);
/// Bytes of the saved state of a chain with this number of sites.
double disk_needed(double sites);

/// Checks a problem without allocating memory. `share_of_machine` is the part of the chain on this machine (Ranks).
/// \throws InputError for numbers out of range, a grid too coarse for a dislocation, an unstable step, or too little
/// memory on this machine.
void check(const Problem& problem, double share_of_machine = 1);

}  // namespace slipfront::chain
