#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include "lattice/chain/explicit/forces.hpp"
#include "lattice/chain/explicit/levels/kernel.hpp"
#include "lattice/chain/explicit/levels/scheme.hpp"
#include "lattice/chain/explicit/levels/slab.hpp"
#include "lattice/chain/explicit/sweep.hpp"
#include "lattice/chain/model/blocks.hpp"
#include "slipfront/lattice/chain/chain.hpp"
#include "system/ranks.hpp"

namespace slipfront::chain {

/// The sites of one rank, divided into slabs that threads share. Calls marked (all) exchange messages between
/// ranks.
class RankSites {
 public:
  /// Creates the arrays for t = level dt. \throws InputError for more threads or ranks than the chain can have.
  RankSites(const Problem& problem, const Execution& execution, const Ranks& ranks, long level);
  RankSites(const RankSites&) = delete;
  RankSites& operator=(const RankSites&) = delete;

  const Problem& problem() const { return problem_; }
  const Scheme& scheme() const { return scheme_; }
  const EndConditions& ends() const { return ends_; }
  const Forces& forces() const { return forces_; }
  std::size_t begin() const { return begin_; }  ///< first site of this rank
  std::size_t end() const { return end_; }      ///< one past the last site of this rank
  long level() const { return level_; }
  double time() const { return static_cast<double>(level_) * scheme_.dt; }
  /// Largest number of levels until the next exchange.
  std::size_t depth() const { return std::min(depth_, forces_.reach()); }

  /// Reads the levels from `source`, in pieces.
  void fill(const LevelsOf& source);
  /// (all) Advances by `count` levels, at most `depth`.
  void advance(std::size_t count);
  /// \throws NumericsError
  void check_numbers() const;

  /// (all) Gets the halos from neighbours, also around a periodic chain. Values from across its seam are not changed by
  /// the turns of its charge.
  void exchange();
  /// Copies z / 2 pi of `size` sites from site `first` on, now and at the level before. The sites may be past an end
  /// or, after an exchange, in the halo of this rank.
  void copy_levels(long first, std::size_t size, double* before, double* now) const;

  /// The levels of those sites of [begin, end) that this rank has.
  Levels levels(std::size_t begin, std::size_t end) const;
  /// (all) The works of all ranks, block by block, and the outflow through the two ends.
  std::vector<double> flow_sums() const { return flow_sums(meter_.sums); }
  void continue_flows(const std::vector<double>& sums);
  Flows flows() const;  ///< (all)

 private:
  std::vector<double> flow_sums(const std::vector<double>& mine) const;
  std::pair<double, double> site(long j) const;
  void check_execution() const;
  void add_potential(double strength, std::vector<double>& energies) const;
  void make_slabs();
  void exchange_with_ranks();
  void exchange_slab(std::size_t i);
  template <class Each>
  void for_slabs(std::size_t levels, const Each& each);

  const Ranks& ranks_;
  Problem problem_;
  Scheme scheme_;
  EndConditions ends_;
  Execution execution_;
  Blocks blocks_;
  std::size_t first_block_, end_block_;  ///< blocks of this rank
  std::size_t begin_, end_;              ///< sites of these blocks
  Forces forces_;
  WorkMeter meter_;
  std::vector<Slab> slabs_;
  std::vector<Sweep> sweeps_;  ///< one for each slab
  long level_;
  std::size_t depth_ = halo;
};

}  // namespace slipfront::chain
