#pragma once

#include <vector>

#include "slipfront/chain/chain.hpp"
#include "slipfront/output/snapshot.hpp"

namespace slipfront::chain {

using output::Dislocation;

/// (all) All dislocations at `time` (Sites::window), from left to right; sixth-order interpolation between sites.
std::vector<Dislocation> dislocations(const Sites& chain, double time);
std::vector<Dislocation> dislocations(const Sites& chain);

/// (all) u of all sites at `time`. Only rank 0 gets them.
std::vector<double> displacements(const Sites& chain, double time);

}  // namespace slipfront::chain
