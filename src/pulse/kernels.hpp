#pragma once

#include <cstddef>

/// The loops over cells and faces where a pulse run spends its time, as vector code chosen at run time (AVX-512, AVX2
/// or plain).
namespace slipfront::pulse {

/// modulation::resolve for many cells. `s` = tanh(psi) comes in as the guess and goes out as the result. Cells that are
/// out of the ordinary (s outside 1e-290 ... 0.9, or a guess too far off) are left with good = 0 for the scalar route.
struct ResolveArrays {
  std::size_t size;
  const double* spacing;
  const double* momentum;
  double* s;
  double* phi;
  double* psi;
  double* sound_speed;
  double* EK;
  double* velocity;  ///< tanh(phi)
  double* good;      ///< 1 or 0
};
void resolve_all(const ResolveArrays& a);

/// Values at the cell centres from cell averages, and back: the second difference over 24, fourth order. Left out where
/// the fourth difference is no smaller than the second (there f is not smooth on the grid, and average and centre value
/// are the same to the order that is left), and in the two cells at each end.
void centre_values(std::size_t size, const double* averages, double* values);
void cell_means(std::size_t size, const double* values, double* averages);

/// Face values of the Riemann invariants by WENO: `plus` from the left, `minus` from the right; p[f - 1] and p[f] are
/// the cells beside face f, with three ghosts at each end. phi = (plus + minus) / 2, psi = max((plus - minus) / 2, 0).
void weno_faces(std::size_t faces, const double* plus, const double* minus, double scale, double* phi, double* psi);

/// U = tanh(phi), p = 2 sinh^2 psi. Returns nothing else: |phi| < 350, psi < 350 as everywhere in a run.
void face_fluxes(std::size_t faces, const double* phi, const double* psi, double* U, double* p);

}  // namespace slipfront::pulse
