#pragma once

#include "friction_ratio/front_layout.hpp"

namespace slipfront::friction_ratio {

/// tools/friction_ratio generates these tables.
extern const front_layout::FrontTable front_coefficients;
extern const front_layout::DropTable drop_coefficients;

}  // namespace slipfront::friction_ratio
