#pragma once

#include "slipfront/chain/chain.hpp"

namespace slipfront::chain {

/// \throws InputError for conditions that implicit steps do not support, and for loading out of range.
void check_implicit(const Problem& problem, const Execution& execution);

}  // namespace slipfront::chain
