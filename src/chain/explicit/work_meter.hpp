#pragma once

#include <cstddef>
#include <vector>

#include "chain/explicit/forces.hpp"
#include "chain/explicit/levels/slab.hpp"
#include "chain/model/blocks.hpp"

namespace slipfront::chain {

/// Measures the work of the forcing and of friction on the sites of one rank, for each level and block. It has the
/// fourth order of the scheme. For a step from u to u + D, with the second difference B of u over levels, the work
/// follows from
///     int F u_t dt = F_mean D + (F_next - F_before) B / 12,     int u_t^2 dt = (D^2 + B^2 / 12) / dt,
/// up to terms that cancel from step to step.
class WorkMeter {
 public:
  /// Measures nothing unless `active`.
  WorkMeter(const Problem& problem, bool active, const Scheme& scheme, const Blocks& blocks, std::size_t first_block,
            std::size_t end_block);

  bool active() const { return !u_.empty(); }
  /// Sets the start: z of `size` sites from `begin` on.
  void start(const Forces& forces, std::size_t begin, std::size_t size, const double* z);
  /// Scratch arrays for the work on one piece of the chain. Each thread needs its own.
  struct Room {
    explicit Room(std::size_t size) : D(size), B(size), friction(size) {}
    Aligned D, B;
    Aligned friction;  ///< the friction forces that were applied
  };
  /// Measures a step of sites [begin, end) from level `now`, which must be the level of the forces, to `next`. The
  /// arrays hold z from site `begin` on. A piece must end with a block, or at a multiple of `piece` sites after the
  /// beginning of its block.
  void add(const Forces& forces, std::size_t begin, std::size_t end, const double* before, const double* now,
           const double* next, Room& room);
  static constexpr std::size_t piece = 1024;  ///< sites whose arrays all fit into the innermost cache

  /// Number of kinds of energy that are measured. The forcing supplies energy, and friction dissipates it. If contacts
  /// change, they give energy to the substrate.
  static std::size_t kinds(const Problem& problem) { return problem.friction.changes_contacts() ? 3 : 2; }
  /// The energies of each block of this rank, one block after the other.
  std::vector<double> sums;

 private:
  /// Adds `strength` times the work on sites [begin, end) to the sums of their blocks. `which` is 0 for supplied, 1 for
  /// dissipated and 2 for the energy of contacts. work(at, size) must return the sum over `size` sites from begin + at
  /// on.
  template <class Work>
  void add_to_blocks(std::size_t begin, std::size_t end, std::size_t which, double strength, const Work& work);

  const Problem* problem_;
  double dt_;
  Blocks blocks_;
  std::size_t first_block_, begin_;
  std::vector<std::size_t> begins_;  ///< first sites of the blocks of this rank, and the end of the last block
  std::vector<double> u_;            ///< u / 2 pi at the present level
};

}  // namespace slipfront::chain
