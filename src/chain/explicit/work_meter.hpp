#pragma once

#include <cstddef>
#include <vector>

#include "chain/explicit/forces.hpp"
#include "chain/explicit/levels/slab.hpp"
#include "chain/model/blocks.hpp"

namespace slipfront::chain {

/// Work of the forcing and of friction on the sites of one rank, level by level and block by block, to the fourth order
/// of the scheme. Over a step from u to u + D, with B the second difference of u over levels,
///     int F u_t dt = F_mean D + (F_next - F_before) B / 12,     int u_t^2 dt = (D^2 + B^2 / 12) / dt,
/// up to terms that cancel from step to step.
class WorkMeter {
 public:
  /// Meters nothing unless `active`.
  WorkMeter(const Problem& problem, bool active, const Scheme& scheme, const Blocks& blocks, std::size_t first_block,
            std::size_t end_block);

  bool active() const { return !u_.empty(); }
  /// Where this rank starts from: z of `size` sites from `begin` on.
  void start(const Forces& forces, std::size_t begin, std::size_t size, const double* z);
  /// Arrays for the work on one piece of the chain: one for each thread.
  struct Room {
    explicit Room(std::size_t size) : u(size), S(size), D(size), B(size), friction(size) {}
    Aligned u, S, D, B;
    Aligned friction;  ///< the forces that it applied
  };
  /// Meters a step of sites [begin, end) from level `now`, that of the forces, to `next`. The arrays hold z from site
  /// `begin` on. Pieces end where blocks do, or a multiple of `piece` sites behind the beginning of their block.
  void add(const Forces& forces, std::size_t begin, std::size_t end, const double* before, const double* now,
           const double* next, Room& room);
  static constexpr std::size_t piece = 1024;  ///< sites that fit the innermost cache with all that belongs to them

  /// Kinds of energy that are metered: supplied by the forcing, dissipated by friction, and where contacts change what
  /// they give to the substrate.
  static std::size_t kinds(const Problem& problem) { return problem.friction.changes_contacts() ? 3 : 2; }
  /// That of each block of this rank, one after the other.
  std::vector<double> sums;

 private:
  /// Adds to supplied (0), dissipated (1) or the contacts' energy (2) of each block `strength` times the work on its
  /// sites of [begin, end), where work(at, size) is the sum over `size` sites from begin + at on.
  template <class Work>
  void add_to_blocks(std::size_t begin, std::size_t end, std::size_t which, double strength, const Work& work);

  const Problem* problem_;
  double dt_;
  Blocks blocks_;
  std::size_t first_block_, begin_;
  std::vector<std::size_t> begins_;  ///< of the blocks of this rank, and the end of the last
  std::vector<double> u_;            ///< u / 2 pi now
};

}  // namespace slipfront::chain
