#pragma once

#include <vector>

#include "pulse/space/block.hpp"

namespace slipfront::pulse {

/// The trains at the cell centres: spacing and momentum of one dislocation, and the state that they mean. Where the
/// contact ratio a(x) is not 1, all are in the local units a x, a t.
struct CellStates {
  std::vector<double> spacing, momentum;
  std::vector<double> s;  ///< tanh(psi); on entry to `solve`, where its solves start
  std::vector<double> phi, psi, sound_speed, EK, velocity;

  void resize(std::size_t size);
  /// Finds everything from spacing and momentum; gaps are left as they are. \throws NumericsError with time and cell
  /// where no state exists. Of the cells of `awake`.
  void solve(const std::vector<Block>& blocks, CellRange awake, double time);
  /// Only s, velocity and the largest slip velocities 2 sinh |phi| cosh psi, of the first `size` trains. Where no state
  /// exists, a train stays without one.
  void solve_slip(std::size_t size, double* fastest);
  bool solved(std::size_t i) const { return solved_[i] != 0; }

 private:
  /// The same by vector code alone, which leaves some trains without a solution.
  void solve_vector(std::size_t begin, std::size_t end);
  void solve_one(std::size_t i);
  std::vector<double> solved_;
};

}  // namespace slipfront::pulse
