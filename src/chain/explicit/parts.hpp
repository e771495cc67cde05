#pragma once

#include <functional>
#include <memory>
#include <utility>
#include <vector>

#include "chain/explicit/forces.hpp"
#include "chain/explicit/levels/scheme.hpp"
#include "chain/explicit/levels/slab.hpp"
#include "chain/explicit/work_meter.hpp"
#include "chain/implicit/implicit.hpp"
#include "chain/model/blocks.hpp"
#include "foundation/ranks.hpp"
#include "slipfront/chain/chain.hpp"

namespace slipfront::chain {

/// What one rank has of a chain, cut into slabs, a thread each. Calls marked (all) are messages between ranks.
struct Chain::Parts {
  const Ranks& ranks;
  Problem problem;
  Scheme scheme;
  Sides sides;
  Execution execution;
  Blocks blocks;
  std::size_t first_block, end_block;  ///< of this rank
  std::size_t begin, end;              ///< their sites
  Forces forces;
  bool level_by_level;  ///< and works are metered; else 32 levels at a time, tile by tile
  WorkMeter meter;
  std::vector<Slab> slabs;
  long level = 0;
  std::unique_ptr<ImplicitSteps> implicit;  ///< has the motion instead of the slabs, where steps are implicit
  /// What a slab needs to advance by one level, piece by piece: where pieces begin and end, arrays for one piece.
  struct ByLevel {
    std::vector<std::size_t> cuts;
    Aligned next, y;
    WorkMeter::Room work;
  };
  std::vector<ByLevel> by_level;  ///< for each slab; empty unless level_by_level
  std::size_t depth = halo;       ///< levels between exchanges

  Parts(const Problem& p, const Execution& e, long at);
  static const Ranks& ranks_of(const Execution& e);

  /// From `source`, a piece at a time.
  void fill(const std::function<Levels(std::size_t begin, std::size_t end)>& source);
  /// (all) `count` <= depth levels.
  void advance(std::size_t count);
  /// \throws NumericsError
  void check_numbers() const;

  /// (all) Halos from neighbours, around a periodic chain too; across its seam the values are left as they are.
  void exchange();
  /// z / 2 pi of site j at both levels, also beyond the ends; in this rank's halo after an exchange.
  std::pair<double, double> site(long j) const;
  /// Of sites that are at most 4 beyond this rank's, after an exchange.
  Window window(std::size_t from, std::size_t to, double time) const;

 private:
  struct ThreeLevels;
  ThreeLevels three_levels(std::size_t from, std::size_t to) const;
  void exchange_with_ranks();
  void exchange_slab(std::size_t i);
  void advance_slab(std::size_t i, std::size_t count);
  void advance_by_one_level(std::size_t i);
};

/// For what is measured rank by rank.
struct Inside {
  static Chain::Parts& of(const Chain& chain) { return *chain.parts_; }
};

}  // namespace slipfront::chain
