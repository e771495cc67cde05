#pragma once

#include <cstddef>
#include <vector>

#include "chain/explicit/forces.hpp"
#include "chain/model/blocks.hpp"

namespace slipfront::chain {

/// Measures the work of the forcing and of friction on the sites of one rank, for each level and block. It has the
/// fourth order of the scheme. For a step from u to u + D, with the second difference B over levels, the work follows
/// from
///     int F u_t dt = F_mean D + (F_next - F_before) B / 12,     int u_t^2 dt = (D^2 + B^2 / 12) / dt,
/// up to terms that cancel from step to step. B is that of u for friction. For a force that changes, that of z is
/// enough.
class WorkMeter {
 public:
  WorkMeter(const Problem& problem, const Scheme& scheme, const Blocks& blocks, std::size_t first_block,
            std::size_t end_block);

  /// Whether there is any work to measure.
  bool active() const { return !begins_.empty(); }
  /// Whether D of the step before is needed, and B.
  bool needs_two_steps() const { return needs_two_steps_; }
  bool needs_B() const { return needs_B_; }

  /// A step of consecutive sites.
  struct Steps {
    const double *D, *D_before, *B, *u;  ///< D_before is of the step before; u (turns) at the end of the step
    const double* applied;               ///< friction that is neither linear nor constant
    friction::LocalStates states;
    double *scratch, *further;  ///< room for as many numbers; `further` may be `applied`
  };
  /// Measures a step of sites [begin, end), which are whole blocks, from the level of the forces.
  void add(const Forces& forces, std::size_t begin, std::size_t end, const Steps& steps);

  /// The energies of each block of this rank, one block after the other: those supplied, dissipated, and, if contacts
  /// change, given to the substrate by them; each as a sum of `lanes` numbers.
  std::vector<double> sums;
  static std::size_t sums_of_block(const Problem& p) { return lanes * kinds(p); }
  static std::size_t kinds(const Problem& p) { return p.friction.changes_contacts() ? 3 : 2; }

 private:
  void add_friction(std::size_t begin, std::size_t end, const Steps& steps);
  /// Adds to the energies `which`. add_to(sums, factor, at) must add `factor` times the works on sites from begin + at
  /// on.
  template <class AddTo>
  void add(std::size_t which, std::size_t begin, std::size_t end, double strength, const AddTo& add_to);

  const Problem* problem_;
  double dt_;
  Blocks blocks_;
  std::size_t first_block_, sums_of_block_;
  bool needs_two_steps_ = false, needs_B_ = false;
  std::vector<std::size_t> begins_;  ///< first sites of the blocks of this rank, and the end of the last block
};

}  // namespace slipfront::chain
