#pragma once
/// \file
/// What a run will take, before anything is allocated.

#include <string>

#include "pulse/solver.hpp"
#include "slipfront/chain/run.hpp"
#include "slipfront/scenario/scenario.hpp"
#include "slipfront/setup/compare.hpp"

namespace slipfront::setup {

struct Estimate {
  double outputs;  ///< output times, t = 0 and the end among them
  double memory;   ///< bytes: the solver, and all that is observed
  double disk;     ///< bytes of the file, with the state to resume from

  /// Bytes while the file is written: it is made in memory, by a copy of the process.
  double memory_with_file() const { return memory + 2 * disk; }
};

Estimate estimate_of(const scenario::Scenario& scenario, const pulse::Problem& problem);
Estimate estimate_of(const scenario::Scenario& scenario, const chain::ScaledProblem& chain);
/// Levels run one after the other; what each observed is kept until the end.
Estimate estimate_of(const scenario::Scenario& scenario, const Comparison& comparison);

/// "12 snapshots: 0.1 GB of memory, 0.02 GB on the disk with -o".
std::string in_words(const Estimate& estimate);

/// \throws InputError, which says both, if a run needs more memory than this process may have. Of a chain that several
/// processes share, `share_of_machine` is on this machine.
void require_memory(const scenario::Scenario& scenario, const pulse::Problem& problem);
void require_memory(const scenario::Scenario& scenario, const chain::ScaledProblem& chain, double share_of_machine = 1);
void require_memory(const scenario::Scenario& scenario, const Comparison& comparison);

}  // namespace slipfront::setup
