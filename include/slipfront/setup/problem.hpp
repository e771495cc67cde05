#pragma once
/// \file
/// Converts a scenario to the problems that the pulse solver and the chain solver solve.

#include "slipfront/chain/run.hpp"
#include "slipfront/pulse/run.hpp"
#include "slipfront/scenario/scenario.hpp"

namespace slipfront::setup {

/// The problem of a scenario that pulse and chain share. If the scenario gives no domain, we choose one that contains
/// all waves until the end. \throws InputError if that is impossible, so that the scenario must give the domain.
pulse::Problem stated_problem(const scenario::Scenario& scenario);

/// The problem for the pulse solver. \throws InputError also for scenarios that need the chain solver, because averages
/// over a train do not describe them. Such a scenario has springs that load every site, friction that changes contacts
/// or pores, or no substrate. (Under springs, dislocations are created; the averaged equations conserve them.)
pulse::Problem pulse_problem(const scenario::Scenario& scenario);

/// Output times and output grid: t = 0, the output times of the scenario, and the end. \throws InputError if the
/// results would not fit into memory.
output::Schedule pulse_schedule(const scenario::Scenario& scenario, const pulse::Problem& problem);

/// The chain problem of a scenario, on the same domain as its pulse. \throws InputError if the scenario has none.
chain::ScaledProblem chain_problem(const scenario::Scenario& scenario);

}  // namespace slipfront::setup
