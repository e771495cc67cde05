#pragma once
/// \file
/// Numbers that decide how a scenario behaves, known before it runs.

#include <optional>

#include "slipfront/scenario/scenario.hpp"

namespace slipfront::setup {

/// Absent numbers do not apply to the scenario. Lengths are in b / A, stiffness in the unit of the model.
struct Numbers {
  std::optional<double> strength_over_direct_effect;  ///< f_0 / a of rate-and-state friction
  /// kappa_c = ((b - a) / D_c) (1 + v^2 / (a D_c)) at the velocity v of the springs: softer springs let steady sliding
  /// become unstable (docs/loading.md).
  std::optional<double> critical_stiffness;
  std::optional<double> stiffness_ratio;  ///< kappa / kappa_c, if the springs pull everywhere
  /// 2 pi / sqrt(kappa_c - kappa), the shortest wave along the interface that grows without a substrate. A shorter
  /// interface slides steadily.
  std::optional<double> nucleation_length;
  std::optional<double> dislocations;  ///< in the domain at t = 0
  std::optional<double> length;        ///< length of the domain
};

/// \throws InputError if the domain is needed and not given.
Numbers numbers_of(const scenario::Scenario& scenario);

}  // namespace slipfront::setup
