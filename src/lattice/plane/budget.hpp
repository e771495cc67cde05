#pragma once
/// \file
/// The balance of energy of a run on a plane.

#include <string>

#include "slipfront/lattice/plane/problem.hpp"

namespace slipfront::plane {

/// Energy of all lines per area that counts as nothing, in units of the energy of one line per width.
inline constexpr double no_energy = 1e-12;

struct Budget {
  explicit Budget(const Energies& energies);

  double largest = 0;  ///< size of the largest part
  double missing = 0;  ///< energy that the parts lack; negative: energy from nothing
  /// `missing` in words, as a fraction of the largest part.
  std::string in_words() const;
};

/// Coarse cells lose some energy, but none may come from nothing. \throws NumericsError, which ends with `remedy`, if
/// more than a tenth of the largest part, and more than `noise`, does.
void check_budget(const Energies& energies, double noise, double time, const std::string& remedy);

}  // namespace slipfront::plane
