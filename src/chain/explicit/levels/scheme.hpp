#pragma once

#include "chain/explicit/levels/kernel.hpp"
#include "slipfront/chain/problem.hpp"

/// The numbers of one time step. With S = a^2 sin u, g = C dt / 2, lambda = dt / h, and d2 the second difference over
/// sites, the sine-Gordon equation becomes (docs/chain.md)
///     (1 - theta)(e^g u_N + e^-g u_S) - (2 + 10 theta) u - (lambda^2 + theta) d2 u
///         = -(dt^2 / 12)(e^g S_N + e^-g S_S + 10 S + d2 S),      theta = (cosh g - 1) / (cosh g + 5),
/// fourth order for 1 - lambda^2 = O(h^2), and u = 2 pi n stays put. It is explicit in z = u + eps S, with S a function
/// of z (PeriodicForce): one such function a site. The lattice is second order in dt and has z = u.
namespace slipfront::chain {

struct Scheme {
  double h = 0, dt = 0;
  double eps = 0;    ///< z = u + eps S
  LevelRule rule;    ///< one step, C included where friction is viscous
  double force = 0;  ///< what a force that is the same at all five points adds to z at the next level
  double share_next = 0, share_now = 0, share_before = 0,
         share_neighbour = 0;  ///< how `force` is shared among the five
};

Scheme scheme_of(const Problem& problem);

}  // namespace slipfront::chain
