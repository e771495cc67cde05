#pragma once

#include "friction_ratio/layout.hpp"

namespace slipfront::friction_ratio {

/// Made by tools/friction_ratio.
extern const layout::Table coefficients;
extern const layout::Corners corners;

}  // namespace slipfront::friction_ratio
