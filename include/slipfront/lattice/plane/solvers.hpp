#pragma once
/// \file
/// The solvers on a fault plane: averages of closed loops and on a grid, and every dislocation line.

#include <memory>

#include "slipfront/lattice/plane/problem.hpp"

namespace slipfront {
class Ranks;
}

namespace slipfront::plane {

/// Numbers of cells of the loops.
struct Resolution {
  int loops = 60;    ///< cells along the label q, which counts dislocation lines from the outside inwards
  int angles = 128;  ///< directions around the origin; 1: all directions are equal (rings)
};

/// The averaged equations for star-shaped ruptures: each direction from the origin crosses each line once. The solver
/// follows the closed dislocation lines around the origin, as distances r(angle, label). A bent line has a tension,
/// which slows a rupture. \throws InputError for an initial slip whose contours are not star-shaped, or that does not
/// vanish inside the domain; for a held region that is not around the origin; for fewer than 4 loops, or 2 to 7 angles;
/// and for friction with state variables, or with strength at rest. Its `advance_to` \throws NumericsError also if
/// friction has taken more energy than the lines released, by more than a tenth.
std::unique_ptr<Solver> loops_solver(const Problem& problem, const Resolution& resolution);

/// The averaged equations on a fixed grid: for ruptures of any shape, several of them, and lines that walk around a
/// barrier. A static load or friction may hold the initial state. The solver follows the mean slip and the wave action
/// in each cell. The rupture front is the contour of slip 0, which lies between the centres of cells. Errors are of
/// first order in the size of a cell. `cells`: cells along x, at least 8; those along y have nearly the same size.
/// \throws InputError for an initial slip that is negative, not finite, or 0 everywhere; for friction that changes
/// contacts; for fixed or absorbing edges where there is slip; and for a static load where the slip ends with a
/// gradient above 0.7. Its `advance_to` \throws NumericsError also if the front reaches an edge, and if more than a
/// tenth of the energy has come from nothing. The results do not depend on the number of threads.
std::unique_ptr<Solver> grid_solver(const Problem& problem, int cells, int threads = 1);

struct DirectOptions {
  double scale = 1;      ///< factor by which x, y and t are stretched and friction is divided: as many times the lines
  double spacing = 0.4;  ///< largest spacing of the sites, in widths of a dislocation of the largest contact ratio
  int threads = 1;
  /// The processes that share the sites, each a band of rows; null: one process. They must outlive the solver, and all
  /// of them must make the same calls. All get the same results, to the last bit those of one process, but only the
  /// first one gets lines and the saved state.
  const Ranks* ranks = nullptr;
};

/// Every dislocation line: the sine-Gordon equation in two dimensions, with fourth order in space and time. The edges
/// of the domain are those of the problem. Results are in the units of the scenario: slip, lengths and times are
/// divided by the scale. Slip at a point is the mean over a square whose half width is one spacing of the densest lines
/// at the start. The elastic energy is that of slopes and substrate, and the kinetic energy that of u_t: the averages
/// divide the same sum in another way. \throws InputError for lines too dense for the spacing, for friction that
/// changes contacts, for numbers out of range, and for more ranks than a fourth of the rows of sites. Its `advance_to`
/// \throws NumericsError also if more than a tenth of the energy has come from nothing.
std::unique_ptr<Solver> direct_solver(const Problem& problem, const DirectOptions& options);

/// Approximate number of bytes that every line needs, on all ranks together. \throws InputError for numbers out of
/// range.
double memory_of_direct(const Problem& problem, const DirectOptions& options);

/// In one process: the largest force on the lines at t = 0 without friction, static load and F, as mean over each of nx
/// times ny cells: friction must be at least as strong to hold the initial state. \throws InputError as direct_solver.
double largest_unbalanced_force(const Problem& problem, const DirectOptions& options, int nx, int ny);

}  // namespace slipfront::plane
