#pragma once

#include <cstddef>
#include <vector>

#include "blocks.hpp"
#include "forces.hpp"
#include "slab.hpp"

namespace slipfront::chain {

/// Work of the forcing and of friction on the sites of one rank, level by level and block by block, to the fourth order
/// of the scheme. Over a step from u to u + D, with B the second difference of u over levels,
///     int F u_t dt = F_mean D + (F_next - F_before) B / 12,     int u_t^2 dt = (D^2 + B^2 / 12) / dt,
/// up to what cancels from step to step.
class WorkMeter {
 public:
  WorkMeter(const Problem& problem, const Scheme& scheme, const Blocks& blocks, std::size_t first_block,
            std::size_t end_block);

  /// A level of `slab` is about to be computed: u as it is now. Only once, it is kept then.
  void look(const Forces& forces, const Slab& slab);
  /// z at three levels, `now` being that of the forces.
  void add(const Forces& forces, const Slab& slab, const double* before, const double* now, const double* next);

  /// Supplied and dissipated energy of each block of this rank, one after the other.
  std::vector<double> sums;

 private:
  const Problem* problem_;
  double dt_;
  Blocks blocks_;
  std::size_t first_block_, end_block_, begin_;
  std::vector<double> u_, next_, room_;  ///< u / 2 pi now and at the next level
  std::vector<char> known_;              ///< by block, whether u_ is
};

}  // namespace slipfront::chain
