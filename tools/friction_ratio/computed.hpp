#pragma once
/// \file
/// What the table of friction ratios is made from and checked against: runs of the pulse solver.

#include <array>

#include "friction/ratio/layout.hpp"
#include "solve.hpp"

namespace slipfront::friction_ratio {

inline constexpr friction::Closure closures[layout::closures] = {friction::Closure::consistent,
                                                                 friction::Closure::paper};

using Logarithms = std::array<double, layout::measures>;  ///< ln of W over the frictionless W(0)

/// \throws InputError, NumericsError as the solver does.
Logarithms computed(friction::Closure closure, double stress, double damping);

}  // namespace slipfront::friction_ratio
