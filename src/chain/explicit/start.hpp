#pragma once

#include <cstddef>

#include "chain/explicit/forces.hpp"
#include "chain/explicit/levels/scheme.hpp"
#include "foundation/ranks.hpp"
#include "slipfront/chain/chain.hpp"

namespace slipfront::chain {

/// What a start is looked at for while it is read.
class StartCheck {
 public:
  /// \throws InputError where something is not finite.
  void look(const Problem& problem, const Motion& motion, std::size_t first);
  /// (all) \throws InputError if the grid is too coarse for the steepest place.
  void finish(const Problem& problem, const Ranks& ranks) const;

 private:
  double steepest_ = 0, at_ = 0;  ///< rise between two neighbours, and where
};

/// \throws InputError if the ends of a periodic chain do not differ by its charge.
void check_charge(const Problem& problem, const MotionOf& start);

/// The two levels, at 0 and -dt, of sites [begin, end) of a motion given by u and velocity at t = 0: Taylor in t to
/// dt^5, derivatives from the equation of motion.
Levels first_levels(const Problem& problem, const Scheme& scheme, const Forces& forces, const MotionOf& start,
                    std::size_t begin, std::size_t end, StartCheck& check);

}  // namespace slipfront::chain
