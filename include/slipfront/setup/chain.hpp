#pragma once
/// \file
/// From a scenario to what the chain runs.

#include "slipfront/chain/run.hpp"
#include "slipfront/scenario/scenario.hpp"

namespace slipfront::setup {

/// The chain that a scenario asks for, over the same domain as its pulse. \throws InputError where that is none.
chain::ScaledProblem chain_problem(const scenario::Scenario& scenario);

}  // namespace slipfront::setup
