#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "lattice/chain/model/periodic_force.hpp"

namespace slipfront::chain {

/// All that an explicit chain needs to continue, to the same bits: two levels of z / 2 pi (docs/chain.md), and the
/// state of friction if it has any.
struct Levels {
  long level = 0;  ///< steps done
  std::vector<double> now, before;
  /// The friction law's state variables, site by site, and those of contacts that change (state_names in
  /// contact_field.hpp). Empty at a start.
  std::vector<double> state = {};
};

/// The levels of sites [begin, end), for chains that no process holds whole.
using LevelsOf = std::function<Levels(std::size_t begin, std::size_t end)>;

/// The force S = a^2 sin u of a substrate of strength a^2, as a function of z = u + eps S. It is a^2 times a
/// PeriodicForce whose coefficients are polynomials in a^2, so that no equation is solved for u.
struct ContactForce {
  static constexpr int powers = 5;
  double c[PeriodicForce::terms][powers] = {};

  /// Coefficient k of the PeriodicForce. It is always inlined, with its loops unrolled, so that loops over sites become
  /// vector code.
  [[gnu::always_inline]] double coefficient(int k, double a2) const {
    double p = c[k][powers - 1];
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC unroll 16
#endif
    for (int i = powers - 2; i >= 0; --i) p = p * a2 + c[k][i];
    return p;
  }
};

/// The force for 0 <= a^2 <= `most`. Its error is that of PeriodicForce at eps a^2.
ContactForce contact_force(double eps, double most);

}  // namespace slipfront::chain
