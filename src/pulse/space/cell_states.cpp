#include "pulse/space/cell_states.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "foundation/text/digits.hpp"
#include "modulation/solve_states.hpp"
#include "slipfront/error.hpp"
#include "slipfront/modulation/per_dislocation.hpp"

namespace slipfront::pulse {
namespace {

/// Dislocations so far apart for their width that a double does not hold psi are as near as it does: psi = 0 is a train
/// without any, whose averages have no number.
constexpr double psi_least = 1e-303;

}  // namespace

void CellStates::resize(std::size_t size) {
  for (auto* array : {&spacing, &momentum, &s, &phi, &psi, &sound_speed, &EK, &velocity, &solved_})
    array->assign(size, 0);
}

void CellStates::solve_vector(std::size_t b, std::size_t end) {
  modulation::solve_states({end - b, &spacing[b], &momentum[b], &s[b], &phi[b], &psi[b], &sound_speed[b], &EK[b],
                            &velocity[b], &solved_[b]});
}

void CellStates::solve_slip(std::size_t size, double* fastest) {
  modulation::solve_slip({size, spacing.data(), momentum.data(), s.data(), phi.data(), psi.data(), sound_speed.data(),
                          EK.data(), velocity.data(), solved_.data()},
                         fastest);
  for (std::size_t i = 0; i < size; ++i) {
    if (solved(i)) continue;
    try {
      solve_one(i);
      fastest[i] = 2 * std::sinh(std::fabs(phi[i])) * std::cosh(psi[i]);
    } catch (const NumericsError&) {
    }
  }
}

void CellStates::solve_one(std::size_t i) {
  const double guess = std::atanh(std::fmin(std::fmax(s[i], 0.0), 1 - 1e-16));
  const modulation::SolvedState at = modulation::solve_state({spacing[i], momentum[i]}, guess);
  phi[i] = at.state.phi;
  psi[i] = std::fmax(at.state.psi, psi_least);
  s[i] = std::tanh(psi[i]);
  sound_speed[i] = at.sound_speed;
  EK[i] = at.EK;
  velocity[i] = std::tanh(at.state.phi);
  solved_[i] = 1;
}

void CellStates::solve(const std::vector<Block>& blocks, CellRange awake, double time) {
  for (const Block& r : blocks) {
    const CellRange part = common(r, awake);
    if (part.empty()) continue;
    solve_vector(part.begin, part.end);
    for (std::size_t i = part.begin; i < part.end; ++i) {
      if (solved_[i] != 0) continue;
      try {
        solve_one(i);
      } catch (const NumericsError& error) {
        throw NumericsError("t = " + digits(time) + ", cell " + std::to_string(i) + " of " + std::to_string(s.size()) +
                            ": " + error.what());
      }
    }
  }
}

}  // namespace slipfront::pulse
