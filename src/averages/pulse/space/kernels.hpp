#pragma once

#include <cstddef>

#include "averages/pulse/space/cell_states.hpp"

/// Loops over cells and faces that take most of the time of a pulse run. The vector code (AVX-512, AVX2 or plain) is
/// chosen at run time.
namespace slipfront::pulse {

/// centre_values converts cell averages to values at the cell centres, and cell_means converts back, both by second and
/// fourth differences: sixth order. Neither applies differences in the two cells at each end, or where the fourth
/// difference is not small compared with the second. There f is not smooth on the grid, and average and centre value
/// agree to the order that remains. Both treat the cells `part` of `size` cells.
void centre_values(std::size_t size, CellRange part, const double* averages, double* values);
void cell_means(std::size_t size, CellRange part, const double* values, double* averages);

/// Face values of the Riemann invariants by WENO: `plus` from the left, `minus` from the right. Entries f - 1 and f are
/// the cells on either side of face f, and there are three ghost cells at each end. phi = (plus + minus) / 2, psi =
/// max((plus - minus) / 2, 0).
void weno_faces(std::size_t faces, const double* plus, const double* minus, double scale, double* phi, double* psi);

/// Fluxes at the faces: U = tanh(phi), but 0 where |phi| is at most `rounding` times psi, and p = 2 sinh^2 psi. |phi| <
/// 350 and psi < 350, as everywhere in a run.
void face_fluxes(std::size_t faces, const double* phi, const double* psi, double rounding, double* U, double* p);

/// Width at the centre of a cell, limited to within 10 % of the mean width. Cells that resolve the width do not reach
/// the limit. Next to a much wider cell the differences can give almost no width, and its pressure would then displace
/// the neighbours.
inline double centre_width(double at_centre, double mean) {
  constexpr double apart = 0.1;
  const double low = (1 - apart) * mean, high = (1 + apart) * mean;
  return at_centre > low ? (at_centre < high ? at_centre : high) : low;
}
/// Converts values at the cell centres to spacing and momentum per dislocation; `width` are the mean widths.
void per_dislocation(std::size_t size, const double* per_charge, const double* width, double* spacing,
                     double* momentum);

/// Hardest collision of trains: the largest value of the fall of phi over two cells less `share` times the sum of their
/// psi. Both terms are doubled, and computed from the invariants with their ghost cells.
double hardest_collision(std::size_t size, const double* plus, const double* minus, double share);

/// Finds plus, minus = phi +- psi, divided by the largest of them, which is returned. Without the division the squares
/// of 1e-300 would underflow.
double invariants(std::size_t size, const double* phi, const double* psi, double* plus, double* minus);

/// Rates of the widths and momenta of the cells, from the fluxes at their faces. Pressures that differ by at most
/// `rounding` of their mean count as equal.
void differences(std::size_t size, const double* U, const double* p, double rounding, double* width_rate,
                 double* momentum_rate);

/// Largest slip velocities 2 sinh |phi| cosh psi of the trains, in local units.
void fastest_slip(std::size_t size, const double* phi, const double* psi, double* fastest);

/// Arrays for free_momenta, which prepares the cells for the action of friction over a time. It finds the size of the
/// `momentum` per dislocation, and the `start` of the search for the momentum after friction: the last one, if there is
/// one. `moves` is 1 if the train can move, else 0. It cannot if its momentum is within rounding of the pressure, or
/// does not exceed `at_rest`, the momentum that friction can take from a train at rest. `spacing` is in local units.
struct FreeArrays {
  std::size_t size;
  const double *charge, *contact, *width, *free, *s, *at_rest, *last;
  double *momentum, *start, *moves, *spacing;
};
void free_momenta(const FreeArrays& a, double time);

/// Arrays for a Newton step for M + weight f(M) = free from M > 0, in many cells. The step is in M if f is nearly
/// proportional to M or nearly constant. Otherwise it is in ln M. In ln M the excess is convex, so that steps from
/// above do not pass the root.
struct NewtonArrays {
  std::size_t size;
  const double *momentum, *free;
  const double *force, *slope;  ///< f at `momentum`, and its derivative with respect to ln M
  double* next;                 ///< limited to the range from `least` times `free` to `free`
};
void take_newton_steps(const NewtonArrays& a, double weight, double least);

/// Values of the trains after a Newton step: velocity, a sinh |phi| e^psi and f at `next`, by their derivatives at
/// `momentum`. `last` is 1 if this is the last step, else 0. It is if ln M changes by at most `last_step`, or if the
/// left side differed from `free` by at most the fraction `precision` before.
struct AfterNewton {
  const double *s, *U, *fastest;  ///< at `momentum`
  double *velocity, *typical, *force, *last;
};
void find_after_newton(const NewtonArrays& a, double weight, double last_step, double precision,
                       const AfterNewton& after);

/// Adds friction with one rate in all cells to the rates of their momenta. Returns the power that friction takes.
double damp(std::size_t size, double rate, const double* momentum, const double* U, double* momentum_rate);

/// Viscous friction rates of closure "paper": C pi^2 / (4 E K), or C if EK is given as 0. Returns the largest.
double paper_rates(std::size_t size, double coefficient, const double* EK, double* rate);

/// Least time in which a wave crosses a cell, |lambda_pm - U| = c0 (1 - U^2) / (1 - |U| c0), or in which the cell loses
/// 0.3 of its width.
double least_crossing_time(std::size_t size, const double* width, const double* width_rate, const double* U,
                           const double* c0);

/// Arrays for implicit steps. Each cell holds a train, with the momenta `on_one` of a dislocation at its two faces.
/// `mass` is cosh(psi) E, an eighth of M / sinh(phi). `pressure` is 2 sinh^2 psi. If the trains at the two faces run
/// into each other, the pressure is that of the two-fan solution between them, which stops them. Nothing is added if
/// they move apart or at equal velocity.
struct StaggeredCells {
  std::size_t size;
  const double *spacing, *phi, *psi, *EK, *contact;
  const double* on_one;  ///< size + 1 values
  double *mass, *pressure;
};
void masses_and_pressures(const StaggeredCells& a);
/// Finds sinh, cosh and tanh of phi at the faces, from the momentum of a dislocation and M / sinh(phi) there.
void face_velocities(std::size_t faces, const double* on_one, const double* mass, double* sinh_phi, double* cosh_phi,
                     double* U);
/// Arrays for trains at faces: their largest slip velocity and s = tanh psi. A train at rest gets a small velocity, at
/// which its friction rate has reached the limit. `per_momentum` is 2 pi / M, by which a mean force becomes a friction
/// rate, or NaN if s is above 0.9. `creep` is a lower bound on the size of sinh(phi).
struct TrainsAtFaces {
  std::size_t size;
  const double *sinh_phi, *psi, *contact;
  double *fastest, *s, *per_momentum;
};
void find_trains(const TrainsAtFaces& a, double creep);

}  // namespace slipfront::pulse
