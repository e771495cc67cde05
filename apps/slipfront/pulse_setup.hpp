#pragma once

#include "slipfront/pulse/run.hpp"
#include "slipfront/scenario/scenario.hpp"

/// The problem that a scenario poses: its domain, where the scenario leaves it open, holds everything that moves until
/// the end.
slipfront::pulse::Problem pulse_problem(const slipfront::scenario::Scenario& scenario);

/// When and where to look at it: t = 0, the output times, the end.
slipfront::pulse::Schedule pulse_schedule(const slipfront::scenario::Scenario& scenario,
                                          const slipfront::pulse::Problem& problem);

const char* law_name(slipfront::modulation::FrictionLaw law);
