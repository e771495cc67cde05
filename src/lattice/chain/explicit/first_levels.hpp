#pragma once

#include <cstddef>

#include "lattice/chain/explicit/forces.hpp"
#include "lattice/chain/explicit/levels/kernel.hpp"
#include "lattice/chain/explicit/levels/scheme.hpp"
#include "lattice/chain/model/initial_train.hpp"

namespace slipfront::chain {

/// The two levels, at 0 and -dt, of sites [begin, end) of a motion given by u and velocity at t = 0: Taylor in t to
/// dt^5, derivatives from the equation of motion.
Levels first_levels(const Problem& problem, const Scheme& scheme, const Forces& forces, const MotionOf& start,
                    std::size_t begin, std::size_t end, StartCheck& check);

}  // namespace slipfront::chain
