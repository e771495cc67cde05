#pragma once
/// \file
/// Averages of a chain in which single dislocations do not show.

#include "slipfront/chain/measure.hpp"

namespace slipfront::chain {

/// Averages around x with the weight 1 + cos(2 pi (x' - x) / width) over a window of that width, or what of it lies on
/// the chain; at `time`, no more than a step away. In a box, a dislocation more or less is all the velocity at small
/// scales; with this weight what is left of the train's ripple falls as the cube of the dislocations in the window.
/// \throws InputError for a window of no width or none of it on the chain.
Average smooth_average(const Chain& chain, double x, double width, double time);

}  // namespace slipfront::chain
