#pragma once

#include "friction_ratio/layout.hpp"

namespace slipfront::friction_ratio {

/// tools/friction_ratio generates these tables.
extern const layout::Table coefficients;
extern const layout::Corners corners;

}  // namespace slipfront::friction_ratio
