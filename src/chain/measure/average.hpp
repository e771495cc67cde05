#pragma once

#include "slipfront/chain/chain.hpp"

namespace slipfront::chain {

/// Averages over [x - width / 2, x + width / 2].
struct Average {
  double x, width;  ///< the window
  double u;         ///< displacement; slip is its increase since t = 0
  double velocity;  ///< u_t
  double stress;    ///< -u_x, from the displacements at the ends of the window
};

/// (all) At `time`, no more than a step away. The window should hold whole spacings 2 pi / k of the train; else one
/// dislocation more or less shows. \throws InputError for a window outside the chain or of no width.
Average average(const Sites& chain, double x, double width, double time);

}  // namespace slipfront::chain
