#pragma once

#include <cstddef>

#include "pulse/space/block.hpp"

/// The loops over cells and faces where a pulse run spends its time, as vector code chosen at run time (AVX-512, AVX2
/// or plain).
namespace slipfront::pulse {

/// modulation::solve_state for many cells. `s` = tanh(psi) comes in as the guess and goes out as the result. Cells that
/// are out of the ordinary (s outside 1e-290 ... 0.9, or a guess too far off) are left with solved = 0 for the scalar
/// route.
struct StateArrays {
  std::size_t size;
  const double* spacing;
  const double* momentum;
  double* s;
  double* phi;
  double* psi;
  double* sound_speed;
  double* EK;
  double* velocity;  ///< tanh(phi)
  double* solved;    ///< 1 or 0
};
void solve_states(const StateArrays& a);
/// Without rapidities, sound speeds and EK, and with the largest slip velocities in local units instead, 2 sinh |phi|
/// cosh psi: all that friction asks for.
void solve_slip(const StateArrays& a, double* fastest);

/// Values at the cell centres from cell averages, and back, by second and fourth differences: sixth order. Left out
/// where the fourth difference is not small beside the second (there f is not smooth on the grid, and average and
/// centre value are the same to the order that is left), and in the two cells at each end. Of `part` of the `size`
/// cells.
void centre_values(std::size_t size, CellRange part, const double* averages, double* values);
void cell_means(std::size_t size, CellRange part, const double* values, double* averages);

/// Face values of the Riemann invariants by WENO: `plus` from the left, `minus` from the right; p[f - 1] and p[f] are
/// the cells beside face f, with three ghosts at each end. phi = (plus + minus) / 2, psi = max((plus - minus) / 2, 0).
void weno_faces(std::size_t faces, const double* plus, const double* minus, double scale, double* phi, double* psi);

/// U = tanh(phi), 0 where |phi| is at most `rounding` of psi; p = 2 sinh^2 psi. |phi| < 350, psi < 350 as everywhere in
/// a run.
void face_fluxes(std::size_t faces, const double* phi, const double* psi, double rounding, double* U, double* p);

/// Width at the centre of a cell, no further from its mean than cells that resolve it have it: next to a cell that is
/// much wider the differences would leave next to nothing, whose pressure throws the neighbours apart.
inline double centre_width(double at_centre, double mean) {
  constexpr double apart = 0.1;
  const double low = (1 - apart) * mean, high = (1 + apart) * mean;
  return at_centre > low ? (at_centre < high ? at_centre : high) : low;
}
/// Spacing and momentum of one dislocation from those at the centres of cells; `width` are means.
void per_dislocation(std::size_t size, const double* per_charge, const double* width, double* spacing,
                     double* momentum);

/// The hardest collision of trains: the largest fall of phi over two cells less `share` of the sum of their psi, both
/// doubled, from the invariants with their ghosts.
double hardest_collision(std::size_t size, const double* plus, const double* minus, double share);

/// plus, minus = phi +- psi over the largest of them, which is returned: the squares of 1e-300 would underflow.
double invariants(std::size_t size, const double* phi, const double* psi, double* plus, double* minus);

/// Rates of the widths and momenta of the cells from the fluxes at their faces. Pressures that differ by `rounding` of
/// them push nothing.
void differences(std::size_t size, const double* U, const double* p, double rounding, double* width_rate,
                 double* momentum_rate);

/// Largest slip velocities 2 sinh |phi| cosh psi of trains, in local units.
void fastest_slip(std::size_t size, const double* phi, const double* psi, double* fastest);

/// Momenta of a dislocation in cells of which friction is about to take for a time: their size, where to start the
/// search for what friction leaves (the last one, if there is one), and whether there is anything (1, else 0). Less
/// than rounding of the pressure is nothing, and so is what cannot overcome `at_rest`, the momentum that friction takes
/// of what rests. Also the spacings of dislocations, in local units.
struct FreeArrays {
  std::size_t size;
  const double *charge, *contact, *width, *free, *s, *at_rest, *last;
  double *momentum, *start, *moves, *spacing;
};
void free_momenta(const FreeArrays& a, double time);

/// A step of Newton's method for M + weight f(M) = free from M > 0, in many cells. In M where f is all but proportional
/// to it or changes little, else in ln M: over that the excess is convex, so that steps from above do not pass the
/// root.
struct NewtonArrays {
  std::size_t size;
  const double *momentum, *free;
  const double *force, *slope;  ///< f at `momentum`, and what it changes by with ln M
  double* next;                 ///< between least times `free` and `free`
};
void take_newton_steps(const NewtonArrays& a, double weight, double least);

/// What such a step makes of the trains at `momentum`: velocity, a sinh |phi| e^psi and f at `next`, by derivatives.
/// And whether it was the last (1, else 0): one of at most `last_step` in ln M, or from where the left side was more
/// than `free` by at most this part of it.
struct AfterNewton {
  const double *s, *U, *fastest;  ///< at `momentum`
  double *velocity, *typical, *force, *last;
};
void find_after_newton(const NewtonArrays& a, double weight, double last_step, double precision,
                       const AfterNewton& after);

/// Adds friction at one rate for all cells to the rates of their momenta; returns the power that it takes.
double damp(std::size_t size, double rate, const double* momentum, const double* U, double* momentum_rate);

/// Viscous friction rates of closure "paper", C pi^2 / (4 E K), C where EK is given as 0; returns the largest.
double paper_rates(std::size_t size, double coefficient, const double* EK, double* rate);

/// Least time in which a wave crosses a cell, |lambda_pm - U| = c0 (1 - U^2) / (1 - |U| c0), or the cell loses 0.3 of
/// its width.
double least_crossing_time(std::size_t size, const double* width, const double* width_rate, const double* U,
                           const double* c0);

/// Of implicit steps. Trains in cells with momenta `on_one` of a dislocation at the faces on either side: their mass
/// cosh(psi) E, an eighth of M / sinh(phi), and their pressure 2 sinh^2 psi. Trains that run into each other are
/// stopped by the pressure of the two-fan solution between them; where they part, or move alike, nothing is added.
struct StaggeredCells {
  std::size_t size;
  const double *spacing, *phi, *psi, *EK, *contact;
  const double* on_one;  ///< size + 1 of them
  double *mass, *pressure;
};
void masses_and_pressures(const StaggeredCells& a);
/// sinh, cosh and tanh of phi at faces, from the momentum of a dislocation there and M / sinh(phi).
void face_velocities(std::size_t faces, const double* on_one, const double* mass, double* sinh_phi, double* cosh_phi,
                     double* U);
/// Trains at faces: their largest slip velocity, that of a train at rest being its limit, and s = tanh psi; and 2 pi
/// over M, by which a mean force slows them, NaN where s is above 0.9. `creep`: sinh(phi) counts as no less.
struct TrainsAtFaces {
  std::size_t size;
  const double *sinh_phi, *psi, *contact;
  double *fastest, *s, *per_momentum;
};
void find_trains(const TrainsAtFaces& a, double creep);

}  // namespace slipfront::pulse
