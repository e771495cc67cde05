#pragma once

#include "lattice/chain/explicit/levels/kernel.hpp"
#include "slipfront/lattice/chain/problem.hpp"

/// The coefficients of one time step. Let S = a^2 sin u, g = C dt / 2 and lambda = dt / h, and let d2 be the second
/// difference over sites. The sine-Gordon equation then becomes (docs/chain.md)
///     (1 - theta)(e^g u_N + e^-g u_S) - (2 + 10 theta) u - (lambda^2 + theta) d2 u
///         = -(dt^2 / 12)(e^g S_N + e^-g S_S + 10 S + d2 S),      theta = (cosh g - 1) / (cosh g + 5),
/// This is of fourth order if 1 - lambda^2 = O(h^2), and keeps u = 2 pi n at rest. The step is explicit in z = u + eps
/// S, because S is a function of z (PeriodicForce), evaluated once for each site. The lattice is of second order in dt
/// and has z = u.
namespace slipfront::chain {

struct Scheme {
  double h = 0, dt = 0;
  double eps = 0;        ///< z = u + eps S
  LevelRule rule;        ///< one step; includes C if friction is viscous
  ContactForce contact;  ///< in place of rule.f if a is not 1 everywhere
  double force = 0;      ///< change of z at the next level by a unit force that is equal at all five points
  double share_next = 0, share_now = 0, share_before = 0,
         share_neighbour = 0;  ///< shares of `force` for the five points
};

Scheme scheme_of(const Problem& problem);

}  // namespace slipfront::chain
