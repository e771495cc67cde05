#pragma once

#include <vector>

#include "pulse/space/block.hpp"

namespace slipfront::pulse {

/// The trains at the cell centres: spacing and momentum of one dislocation, and the state that they determine. With a
/// contact ratio a(x), all are in the local units a x, a t.
struct CellStates {
  std::vector<double> spacing, momentum;
  std::vector<double> s;  ///< tanh(psi); on entry to `solve`, the initial guess
  std::vector<double> phi, psi, sound_speed, EK, velocity;

  void resize(std::size_t size);
  /// Finds the states of the cells of `awake` from spacing and momentum; gaps do not change. \throws NumericsError with
  /// time and cell if no state exists.
  void solve(const std::vector<Block>& blocks, CellRange awake, double time);
  /// Finds only s, velocity and the largest slip velocities 2 sinh |phi| cosh psi of the first `size` trains. `solved`
  /// is false for a train that has no state.
  void solve_slip(std::size_t size, double* fastest);
  bool solved(std::size_t i) const { return solved_[i] != 0; }

 private:
  /// Like `solve`, but only with vector code, which leaves some trains without a solution.
  void solve_vector(std::size_t begin, std::size_t end);
  void solve_one(std::size_t i);
  std::vector<double> solved_;
};

}  // namespace slipfront::pulse
