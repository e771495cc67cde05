#pragma once

#include <functional>

/// An odd force on a site with the period of the substrate, as one polynomial after range reduction. Slip is counted in
/// turns (u / 2 pi), so that range reduction and a shift by whole dislocations are exact.
namespace slipfront::chain {

/// The turn minus the nearest whole number, for |turns| < 2^51, without branches.
[[gnu::always_inline]] inline double part_of_turn(double turns) {
  constexpr double magic = 6755399441055744.0;  // adding this rounds to a whole number
  return turns - ((turns + magic) - magic);
}

struct PeriodicForce {
  static constexpr int terms = 8;
  double c[terms] = {};  ///< coefficients of r, r^3, ...; r is part_of_turn

  /// The force at |turns| < 2^51, without branches. It is always inlined, even in builds for small code, so that loops
  /// over it become vector code.
  [[gnu::always_inline]] double operator()(double turns) const {
    const double r = part_of_turn(turns), z = r * r;
    double p = c[terms - 1];
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC unroll 16
#endif
    for (int k = terms - 2; k >= 0; --k) p = p * z + c[k];
    return r * p;
  }
};

/// Fits the polynomial to an odd function f of period 1, nearly as well as possible in the maximum norm. It keeps
/// f(1/2) = 0, so that the force has no jump and derives from a periodic potential.
PeriodicForce fit(const std::function<double(double turns)>& f);

/// The force on u, sin(2 pi u) / 2 pi, as a function of z = u + eps sin(2 pi u) / 2 pi, 0 <= eps < 0.5.
double force_seen_from(double z, double eps);

/// The polynomial for this force. With eps = h^2 / 12, the largest error in sin u is 3e-11 at h = 0 (a lattice), 8e-10
/// at 0.1, 4e-8 at 0.5 and 1e-7 at 0.7. The error of the grid, h^4 / 240, is at least some hundred times larger.
PeriodicForce substrate_force(double eps);

}  // namespace slipfront::chain
