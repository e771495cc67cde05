#pragma once

#include "slipfront/friction/law.hpp"

namespace slipfront::friction {

const Definition& no_law();
const Definition& viscous_law();
const Definition& coulomb_law();
const Definition& power_law();

}  // namespace slipfront::friction
