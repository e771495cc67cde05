#include "lattice/chain/explicit/levels/scheme.hpp"

#include <cmath>
#include <numbers>

#include "lattice/chain/explicit/levels/kernel.hpp"

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

namespace {

constexpr int powers = ContactForce::powers;

/// The polynomial through `values` at the nodes x, as coefficients of the powers of x: Newton's divided differences,
/// expanded. Equal values give exactly a constant, as on a lattice, where eps is 0.
void interpolate(const double (&x)[powers], double (&values)[powers], double (&c)[powers]) {
  for (int order = 1; order < powers; ++order)
    for (int i = powers - 1; i >= order; --i) values[i] = (values[i] - values[i - 1]) / (x[i] - x[i - order]);
  for (double& coefficient : c) coefficient = 0;
  for (int i = powers - 1; i >= 0; --i) {
    for (int k = powers - 1; k > 0; --k) c[k] = c[k - 1] - x[i] * c[k];
    c[0] = values[i] - x[i] * c[0];
  }
}

}  // namespace

ContactForce contact_force(double eps, double most) {
  double a2[powers];
  PeriodicForce force[powers];
  for (int i = 0; i < powers; ++i) {  // Chebyshev nodes
    a2[i] = most / 2 * (1 + std::cos(std::numbers::pi * (i + 0.5) / powers));
    force[i] = substrate_force(eps * a2[i]);
  }
  ContactForce contact;
  for (int k = 0; k < PeriodicForce::terms; ++k) {
    double values[powers];
    for (int i = 0; i < powers; ++i) values[i] = force[i].c[k];
    interpolate(a2, values, contact.c[k]);
  }
  return contact;
}

}  // namespace slipfront::chain
