#pragma once

#include "friction/ratio/layout.hpp"

namespace slipfront::friction_ratio {

/// The corners of W(0) and of the peak with closure "consistent" (docs/friction_ratio.md), one run of the solver for
/// each Sigma- of the table. "paper" has none below Gamma = 3.
layout::Corners find_corners();

}  // namespace slipfront::friction_ratio
