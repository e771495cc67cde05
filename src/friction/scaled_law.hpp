#pragma once

#include <memory>

#include "slipfront/friction/law.hpp"

namespace slipfront::friction {

/// A law whose force at each position is a share of that of another law, as where the normal stress or the only
/// coefficient of a law varies. The share is the last value in the state of a position.
std::shared_ptr<const Law> scaled_law(std::shared_ptr<const Law> law);

}  // namespace slipfront::friction
