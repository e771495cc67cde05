#pragma once
/// \file
/// From a scenario to what the solvers of pulse and chain run.

#include "slipfront/chain/run.hpp"
#include "slipfront/pulse/run.hpp"
#include "slipfront/scenario/scenario.hpp"

namespace slipfront::setup {

/// The problem that a scenario poses to pulse and chain alike: its domain, where the scenario leaves it open, holds
/// everything that moves until the end. \throws InputError where that takes a domain which is not given.
pulse::Problem stated_problem(const scenario::Scenario& scenario);

/// The same for the pulse. \throws InputError also for what the averages over a train do not have and the chain does:
/// springs that load every place, for nothing says where and when dislocations are born under them, and a surface
/// without a substrate.
pulse::Problem pulse_problem(const scenario::Scenario& scenario);

/// When and where to look at it: t = 0, the output times, the end. \throws InputError if what is to be looked at would
/// not fit into the memory.
output::Schedule pulse_schedule(const scenario::Scenario& scenario, const pulse::Problem& problem);

/// Lays the cells of a problem and forgets them; of very many, some tell what is wrong. \throws InputError as
/// pulse::Run.
void check_cells(const scenario::Scenario& scenario, const pulse::Problem& problem);

/// The chain that a scenario asks for, over the same domain as its pulse. \throws InputError where that is none.
chain::ScaledProblem chain_problem(const scenario::Scenario& scenario);

}  // namespace slipfront::setup
