#pragma once

#include <algorithm>
#include <cstddef>

#include "chain/model/blocks.hpp"
#include "foundation/ranks.hpp"
#include "slipfront/chain/chain.hpp"

namespace slipfront::chain {

/// (all) Calls measure(begin, end) for this rank's sites in order, some 16 384 at a time, in ranges that depend only
/// on the number of sites, and done() after every block.
template <class Measure, class Done>
void for_own_sites(const Sites& chain, const Measure& measure, const Done& done) {
  constexpr std::size_t range = 16384;
  const Ranks& ranks = chain.ranks();
  const Blocks blocks{chain.problem().grid.sites};
  chain.exchange();
  for (std::size_t block = blocks.first_of(ranks.rank(), ranks.size());
       block < blocks.first_of(ranks.rank() + 1, ranks.size()); ++block) {
    const std::size_t end = blocks.begin(block + 1);
    for (std::size_t begin = blocks.begin(block); begin < end; begin += range)
      measure(begin, std::min(begin + range, end));
    done();
  }
}

}  // namespace slipfront::chain
