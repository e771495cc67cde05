#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "system/ranks.hpp"

namespace slipfront::chain {

/// The sites of a chain in blocks, which depend only on the number of sites. Ranks hold whole blocks, and sums over the
/// chain are sums over blocks, added up in order: the same bits whatever the ranks.
struct Blocks {
  static constexpr std::size_t vector = 8;   ///< blocks begin at multiples of it, so that vectors hold the same sites
  static constexpr std::size_t least = 72;   ///< two halos, and a vector that the block before may get
  static constexpr std::size_t few = 64;     ///< so many blocks may be as small as that
  static constexpr std::size_t usual = 256;  ///< a sum takes some time to begin and end, and a tile has whole blocks
  static constexpr std::size_t many = 4096;  ///< if there are more blocks, they are larger
  static constexpr std::size_t most = 2048;  ///< fits into the innermost cache

  std::size_t sites;
  std::size_t count =
      std::max({std::clamp<std::size_t>(sites / least, 1, few), std::min(sites / usual, many), sites / most});

  std::size_t begin(std::size_t block) const {
    if (block == count) return sites;
    return (sites / count * block + sites % count * block / count) / vector * vector;
  }
  /// The block of a site: begin(b) is b sites / count, rounded down to whole vectors.
  std::size_t of(std::size_t site) const {
    return std::min(((site / vector + 1) * vector * count - 1) / sites, count - 1);
  }
  /// The first block of `rank` of `ranks`.
  std::size_t first_of(int rank, int ranks) const {
    return count * static_cast<std::size_t>(rank) / static_cast<std::size_t>(ranks);
  }
  /// The first site of the i-th of some equal parts of the chain.
  std::size_t part_begin(std::size_t i, std::size_t parts) const { return sites * i / parts; }
  std::size_t part_size(std::size_t i, std::size_t parts) const {
    return part_begin(i + 1, parts) - part_begin(i, parts);
  }
  /// Calls each(part, begin, end) for the pieces of equal parts of the chain, in order. A piece is as much of a part as
  /// is in one block.
  template <class Each>
  void each_piece(std::size_t parts, const Each& each) const {
    for (std::size_t part = 0; part < parts; ++part) {
      const std::size_t to = part_begin(part + 1, parts);
      for (std::size_t from = part_begin(part, parts); from < to;) {
        const std::size_t end = std::min(to, begin(of(from) + 1));
        each(part, from, end);
        from = end;
      }
    }
  }
};

/// The blocks of one rank, which are next to each other, and their sites.
struct OwnBlocks {
  OwnBlocks(std::size_t sites, const Ranks& ranks)
      : blocks{sites},
        first(blocks.first_of(ranks.rank(), ranks.size())),
        count(blocks.first_of(ranks.rank() + 1, ranks.size()) - first),
        begin(blocks.begin(first)),
        end(blocks.begin(first + count)) {}

  std::size_t size() const { return end - begin; }
  /// The first site of own block b, counted from the first site of the rank on.
  std::size_t begin_of(std::size_t b) const { return blocks.begin(first + b) - begin; }
  /// (all) The sum of term(j) over the sites of all ranks, where j counts from the first site of the rank on.
  template <class Term>
  double sum(const Ranks& ranks, const Term& term) const {
    std::vector<double> sums(count);
    for (std::size_t b = 0; b < count; ++b)
      for (std::size_t j = begin_of(b); j < begin_of(b + 1); ++j) sums[b] += term(j);
    double all = 0;
    for (const double of_block : ranks.joined(sums)) all += of_block;
    return all;
  }
  /// (all) The mean of value(j) over the sites of each of some equal parts of the chain, with j like that of `sum`.
  template <class Value>
  std::vector<double> means(const Ranks& ranks, std::size_t parts, const Value& value) const {
    std::vector<double> mine, all(parts);
    blocks.each_piece(parts, [&](std::size_t, std::size_t from, std::size_t to) {
      if (from < begin || from >= end) return;
      double sum = 0;
      for (std::size_t j = from; j < to; ++j) sum += value(j - begin);
      mine.push_back(sum);
    });
    const std::vector<double> sums = ranks.joined(mine);
    auto sum = sums.begin();
    blocks.each_piece(parts, [&](std::size_t part, std::size_t, std::size_t) { all[part] += *sum++; });
    for (std::size_t i = 0; i < parts; ++i) all[i] /= static_cast<double>(blocks.part_size(i, parts));
    return all;
  }

  Blocks blocks;
  std::size_t first, count;  ///< blocks of this rank
  std::size_t begin, end;    ///< their sites
};

}  // namespace slipfront::chain
