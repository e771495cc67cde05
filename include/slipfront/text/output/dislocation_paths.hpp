#pragma once
/// \file
/// Numbers the dislocations of a chain, so that each can be followed from one output to the next.

#include <cstddef>
#include <vector>

#include "slipfront/text/output/snapshot.hpp"

namespace slipfront::output {

/// The chain on which dislocations are followed.
struct PathSettings {
  double ring_length = 0;   ///< 0 unless the chain is a ring
  double meeting_time = 0;  ///< for so long a dislocation and an antidislocation that meet may be invisible
};

/// The numbers of the dislocations of each snapshot, in their order.
struct DislocationPaths {
  std::vector<std::vector<std::size_t>> numbers;  ///< from 0: in the order of the first snapshot, then of x
  std::vector<int> signs;                         ///< the sign of each number
};

/// Finds for each dislocation the one of the snapshot before that it continues, by these rules in this order.
///
/// 1. Dislocations of one sign never pass each other. If dislocations of both signs are there, equally many of each as
///    before and equal levels at both ends, the first continues the first of its sign, and so on, unless one would have
///    to be faster than c.
/// 2. If dislocations of both signs are there, but not on a ring, a dislocation that was seen twice continues to the
///    nearest one of its sign, as seen from where it would be at constant velocity.
/// 3. A dislocation continues that of its sign and level; the nearest ones, if there are several. If u falls
///    everywhere, there is one of each level. On a ring, levels count modulo the dislocations less the
///    antidislocations.
/// 4. If dislocations of both signs are there, the rest continues the nearest one of its sign that it can have left no
///    faster than c. Here and in rule 2 that may also be one that was last seen some `meeting_time` or two outputs ago.
///
/// All others are new.
DislocationPaths dislocation_paths(const std::vector<Snapshot>& snapshots, const PathSettings& settings);

}  // namespace slipfront::output
