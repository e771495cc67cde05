#include "chain/explicit/levels/contact_force.hpp"

#include <cmath>
#include <numbers>

namespace slipfront::chain {
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
