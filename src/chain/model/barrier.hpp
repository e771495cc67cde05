#pragma once

namespace slipfront::chain {

/// The largest force F of Eq. 3 at which a grid of this spacing still holds a dislocation at rest (a = 1): the
/// Peierls-Nabarro barrier of the diamond rule, (40 pi / h^2) exp(-pi^2 / h), to 0.3 % for h = 0.25 to 0.7
/// (docs/chain.md).
double barrier_force(double spacing);

/// The spacing, not above the given one, at which the barrier is below `force`, to two digits.
double spacing_with_barrier_below(double force, double spacing);

}  // namespace slipfront::chain
