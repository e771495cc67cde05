#pragma once

#include <functional>

/// A force on a site that is odd and has the period of the substrate, as one polynomial after range reduction. Slip is
/// counted in turns here (u / 2 pi), so that the reduction is exact and so is a shift by whole dislocations.
namespace slipfront::chain {

struct PeriodicForce {
  static constexpr int terms = 8;
  double c[terms] = {};  ///< of r, r^3, ... with r = the turn less the nearest whole number

  /// Branch-free; |turns| < 2^51. Loops over it become vector code, for which it must not stay a call (as it does where
  /// code is to be small).
  [[gnu::always_inline]] double operator()(double turns) const {
    constexpr double magic = 6755399441055744.0;  // adding it rounds to a whole number
    const double r = turns - ((turns + magic) - magic), z = r * r;
    double p = c[terms - 1];
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC unroll 16
#endif
    for (int k = terms - 2; k >= 0; --k) p = p * z + c[k];
    return r * p;
  }
};

/// The polynomial for an odd function f of period 1 (near-minimax, f(1/2) = 0 kept, so that the force has no jump and
/// derives from a periodic potential).
PeriodicForce fit(const std::function<double(double turns)>& f);

/// sin(2 pi u) / 2 pi where z = u + eps sin(2 pi u) / 2 pi: the force on u, seen from z. 0 <= eps < 0.5.
double force_seen_from(double z, double eps);

/// Its polynomial for eps = h^2 / 12. Largest error in sin u: 3e-11 at h = 0 (a lattice), 8e-10 at 0.1, 4e-8 at 0.5,
/// 1e-7 at 0.7; h^4 / 240, the error of the grid, is some hundred times that and more.
PeriodicForce substrate_force(double eps);

}  // namespace slipfront::chain
