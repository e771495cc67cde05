#include "chain/explicit/levels/scheme.hpp"

#include <cmath>

namespace slipfront::chain {

Scheme scheme_of(const Problem& p) {
  Scheme s;
  s.h = p.grid.spacing;
  s.dt = chosen_step(p);
  const double C = p.friction.linear_coefficient().value_or(0);
  const double g = C * s.dt / 2, grow = std::exp(g), fall = std::exp(-g), dt2 = s.dt * s.dt,
               lambda2 = dt2 / (s.h * s.h);
  s.rule.before = fall * fall;
  if (p.model == Model::lattice) {
    // Eq. (1), in units of Eq. 3: e^g u_N + e^-g u_S - 2 cosh(g) u = lambda^2 d2 u - dt^2 S
    s.rule.keep = 1 + s.rule.before - 2 * lambda2 * fall;
    s.rule.spread = lambda2 * fall;
    s.rule.force = s.force = dt2 * fall;
    s.share_now = 1;
  } else {
    const double theta = (std::cosh(g) - 1) / (std::cosh(g) + 5), twelfth = dt2 / 12, scale = (1 - theta) * grow;
    s.eps = twelfth / (1 - theta);
    s.rule.spread = (lambda2 + theta) / scale;
    s.rule.coupled = (twelfth + (lambda2 + theta) * s.eps) / scale / s.rule.spread;  // d2 S, carried by y
    s.rule.keep = 1 + s.rule.before - 2 * s.rule.spread;
    s.rule.force = (10 * twelfth + (2 + 10 * theta) * s.eps) / scale - 2 * s.rule.spread * s.rule.coupled;
    s.force = dt2 / scale;
    s.share_next = grow / 12;
    s.share_before = fall / 12;
    s.share_now = 8.0 / 12;
    s.share_neighbour = 1.0 / 12;
  }
  s.rule.f = substrate_force(s.eps);
  if (p.contact || p.friction.changes_contacts()) {
    const double most = 1 / (least_sites_per_width * s.h);  // check(Problem) accepts no larger a, except on a lattice
    s.contact = contact_force(s.eps, most * most);
  }
  return s;
}

}  // namespace slipfront::chain
