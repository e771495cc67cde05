#pragma once

#include <cstddef>

#include "foundation/ranks.hpp"
#include "slipfront/chain/problem.hpp"

namespace slipfront::chain {

/// Calls `start(begin, end)`. \throws InputError if the result does not have end - begin sites.
Motion sites_of(const MotionOf& start, const Problem& problem, std::size_t begin, std::size_t end);
/// Makes a MotionOf from the motion of the whole chain. `start` must outlive the result.
MotionOf pieces_of(const Motion& start, std::size_t sites);

/// \throws InputError if the chain has too few sites for so many ranks.
void check_ranks(const Problem& problem, const Ranks& ranks);

/// Checks an initial motion while a chain reads it.
class StartCheck {
 public:
  /// \throws InputError for a number that is not finite.
  void look(const Problem& problem, const Motion& motion, std::size_t first);
  /// (all) \throws InputError if the grid is too coarse for the steepest slope.
  void finish(const Problem& problem, const Ranks& ranks) const;

 private:
  double steepest_ = 0, at_ = 0;  ///< largest difference of u between two neighbours, and its x
};

/// \throws InputError if the ends of a periodic chain do not differ by its charge.
void check_charge(const Problem& problem, const MotionOf& start);

}  // namespace slipfront::chain
