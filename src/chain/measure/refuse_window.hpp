#pragma once

#include "slipfront/chain/initial.hpp"

namespace slipfront::chain {

/// \throws InputError: a window that is not on the chain, or has no width.
[[noreturn]] void refuse_window(const Grid& grid, double x, double width);

}  // namespace slipfront::chain
