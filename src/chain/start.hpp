#pragma once

#include "forces.hpp"
#include "scheme.hpp"
#include "slipfront/chain/chain.hpp"

namespace slipfront::chain {

/// The two levels, at 0 and -dt, of a motion given by u and velocity at t = 0: Taylor in t to dt^5, derivatives from
/// the equation of motion.
Levels first_levels(const Problem& problem, const Scheme& scheme, const Forces& forces, const Motion& start);

}  // namespace slipfront::chain
