#pragma once
/// \file
/// The tables of coefficients, which tools/friction_ratio writes as the files *.csv of this folder.

#include "friction_ratio/front_layout.hpp"
#include "friction_ratio/layout.hpp"

namespace slipfront::friction_ratio {

extern const layout::Table coefficients;
extern const layout::Corners corners;
extern const front_layout::FrontTable front_coefficients;
extern const front_layout::DropTable drop_coefficients;

}  // namespace slipfront::friction_ratio
