#include "cell_states.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "../digits.hpp"
#include "kernels.hpp"
#include "slipfront/error.hpp"
#include "slipfront/modulation/per_dislocation.hpp"

namespace slipfront::pulse {

void CellStates::resize(std::size_t size) {
  for (auto* array : {&spacing, &momentum, &s, &phi, &psi, &sound_speed, &EK, &velocity, &solved_})
    array->assign(size, 0);
}

void CellStates::solve(const std::vector<Block>& blocks, double time) {
  for (const Block& r : blocks) {
    const std::size_t b = r.begin;
    solve_states({r.end - b, &spacing[b], &momentum[b], &s[b], &phi[b], &psi[b], &sound_speed[b], &EK[b], &velocity[b],
                  &solved_[b]});
    for (std::size_t i = b; i < r.end; ++i) {  // those that the vector code has left
      if (solved_[i] != 0) continue;
      try {
        const double guess = std::atanh(std::fmin(std::fmax(s[i], 0.0), 1 - 1e-16));
        const modulation::SolvedState at = modulation::solve_state({spacing[i], momentum[i]}, guess);
        phi[i] = at.state.phi;
        psi[i] = at.state.psi;
        s[i] = std::tanh(at.state.psi);
        sound_speed[i] = at.sound_speed;
        EK[i] = at.EK;
        velocity[i] = std::tanh(at.state.phi);
      } catch (const NumericsError& error) {
        throw NumericsError("t = " + digits(time) + ", cell " + std::to_string(i) + " of " + std::to_string(s.size()) +
                            ": " + error.what());
      }
    }
  }
}

}  // namespace slipfront::pulse
