#pragma once

#include <algorithm>
#include <cstddef>

namespace slipfront::chain {

/// The sites of a chain in blocks of 64 or more, which depend only on the number of sites. Ranks hold whole blocks, and
/// sums over the chain are sums over blocks, added up in order: the same bits whatever the ranks.
struct Blocks {
  static constexpr std::size_t least = 64;  ///< two halos
  static constexpr std::size_t most = 4096;

  std::size_t sites;
  std::size_t count = std::clamp<std::size_t>(sites / least, 1, most);

  std::size_t begin(std::size_t block) const { return sites / count * block + sites % count * block / count; }
  /// The block of a site: begin(b) is b sites / count, rounded down.
  std::size_t of(std::size_t site) const { return ((site + 1) * count - 1) / sites; }
  /// The first block of `rank` of `ranks`.
  std::size_t first_of(int rank, int ranks) const {
    return count * static_cast<std::size_t>(rank) / static_cast<std::size_t>(ranks);
  }
};

}  // namespace slipfront::chain
