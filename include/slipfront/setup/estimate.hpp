#pragma once
/// \file
/// What a run will take, before anything is allocated.

#include <cstddef>

#include "slipfront/pulse/solver.hpp"
#include "slipfront/scenario/scenario.hpp"

namespace slipfront::setup {

struct Estimate {
  double outputs;  ///< output times, t = 0 and the end among them
  double memory;   ///< bytes: the solver of the pulse and all that is observed, kept until it is written
  double disk;     ///< bytes of the file; the state to resume from included
};

/// Of the pulse of a scenario, and of what is observed of its chain: the chain's own sites come on top.
Estimate estimate_of(const scenario::Scenario& scenario, const pulse::Problem& problem);

/// \throws InputError, which says both, if a run needs more memory than this process may have.
void require_memory(const scenario::Scenario& scenario, const pulse::Problem& problem);

}  // namespace slipfront::setup
