#pragma once

#include "slipfront/chain/run.hpp"
#include "slipfront/scenario/scenario.hpp"

/// The chain that a scenario asks for, over the same domain as its pulse. \throws InputError where that is none.
slipfront::chain::Stretched chain_problem(const slipfront::scenario::Scenario& scenario);
