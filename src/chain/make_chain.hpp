#pragma once

#include <memory>

#include "slipfront/chain/chain.hpp"

namespace slipfront::chain {

/// A chain of the steps that the problem asks for. \throws InputError as ExplicitChain and ImplicitChain do.
std::unique_ptr<Chain> make_chain(const Problem& problem, const MotionOf& start, const Execution& execution = {});

}  // namespace slipfront::chain
