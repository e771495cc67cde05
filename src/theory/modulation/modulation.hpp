#pragma once
/// \file
/// The states of many trains from their spacings and momenta (solve_state), by vector code that is chosen at run time.

#include <cstddef>

namespace slipfront::modulation {

/// Arrays for solve_state in many cells. `s` = tanh(psi) is the initial guess on entry and the result on
/// exit. Cells with s outside 1e-290 ... 0.9, or with a poor guess, get solved = 0 and need the scalar code.
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
/// Finds guesses of `s` from spacing and momentum. From these, solve_states solves most cells. Overwrites psi.
void find_guesses(const StateArrays& a);
/// Like solve_states, but without rapidities, sound speeds and EK. It finds instead the largest slip velocities in
/// local units, 2 sinh |phi| cosh psi, which are all that friction needs.
void solve_slip(const StateArrays& a, double* fastest);

}  // namespace slipfront::modulation
