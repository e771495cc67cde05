#pragma once

#include <cstddef>
#include <vector>

#include "lattice/chain/events/event_log.hpp"
#include "lattice/chain/implicit/site_forces.hpp"

namespace slipfront::chain {

/// The middles of `count` equal parts of a chain, in b / A.
std::vector<double> middles_of_parts(const Problem& problem, std::size_t count);

/// The equal parts of a chain that are watched for slip events, at most 64: each has eight dislocations or more, or is
/// 60 widths of one long. A smooth surface has no dislocations, and its parts have eight sites or more. Sums over a
/// part are sums over its pieces (Blocks::each_piece), added in order, so the results do not depend on the ranks.
class WatchedParts {
 public:
  /// (all) The parts of the motion `now` of the start. `forces` must outlive this object.
  WatchedParts(const SiteForces& forces, const ChainState& now);

  /// (all) Hands the last step to the log of events of `m`. Slip counts as positive in the direction of the springs.
  void look(ChainState& m);
  /// (all) The load at this moment: the mean force on a site, or the stress at the end that is pulled.
  double load(const ChainState& m);

 private:
  struct Piece {
    std::size_t part, begin, end;  ///< sites of the chain
  };
  void add_up(const ChainState& m);
  double load_by_sums() const;

  const SiteForces& forces_;
  double direction_;  ///< 1, or -1 if the springs pull backward
  ChainParts parts_;
  std::vector<Piece> pieces_;       ///< those of all ranks
  std::size_t first_, count_ = 0;   ///< pieces of this rank
  std::vector<double> mine_, all_;  ///< sums over each piece: u, w, and the force that loads it
};

}  // namespace slipfront::chain
