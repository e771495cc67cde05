#pragma once

#include <cstddef>

#include "chain/explicit/share.hpp"

namespace slipfront::chain {

/// Sites [from, to) of a share, or of at most 4 next to it, after an exchange, at `time`, which is no more than a step
/// away. u and velocity are of fourth order.
Window window_of(const Share& share, std::size_t from, std::size_t to, double time);

}  // namespace slipfront::chain
