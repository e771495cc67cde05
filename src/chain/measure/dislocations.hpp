#pragma once

#include <vector>

#include "slipfront/chain/chain.hpp"

namespace slipfront::chain {

/// One dislocation: u passes pi (mod 2 pi).
struct Dislocation {
  double x;
  int sign;  ///< +1: u falls by 2 pi with x; -1: an antidislocation
};

/// (all) All dislocations, from left to right; sixth-order interpolation between sites.
std::vector<Dislocation> dislocations(const Sites& chain);

}  // namespace slipfront::chain
