#pragma once
/// \file
/// What the tables of fronts and stress drops are made from and checked against: runs of the pulse solver.

#include <functional>
#include <vector>

#include "friction/ratio/layout.hpp"
#include "slipfront/friction/friction.hpp"

namespace slipfront::friction_ratio {

/// The ratio of the observed front at each threshold, and the stress drops over Sigma-.
struct FrontAndDrops {
  std::vector<double> fronts;
  std::array<double, front_layout::drops> drops;
};

/// \throws InputError, NumericsError as the solver does.
FrontAndDrops front_and_drops(friction::Closure closure, double stress, double damping,
                              const std::vector<double>& thresholds);

}  // namespace slipfront::friction_ratio
