#pragma once
/// \file
/// Estimates the memory and the disk space that a run needs, before it allocates anything.

#include <string>
#include <vector>

#include "averages/pulse/solver.hpp"
#include "slipfront/lattice/chain/run.hpp"
#include "slipfront/scenario/scenario.hpp"

namespace slipfront::scenario {

struct Estimate {
  double outputs;  ///< number of output times, including t = 0 and the end
  double memory;   ///< bytes for the solver and all observations
  double disk;     ///< bytes of the file, including the state to resume from

  /// Bytes of memory while the file is written. It is created in memory, by a library that copies it once.
  double memory_with_file() const { return memory + 2 * disk; }
};

Estimate estimate_of(const Scenario& scenario, const pulse::Problem& problem);
Estimate estimate_of(const Scenario& scenario, const chain::ScaledProblem& chain);
/// The levels of a comparison with these chains run one after the other. The observations of all levels stay in memory
/// until the end.
Estimate estimate_of(const Scenario& scenario, const std::vector<chain::ScaledProblem>& chains);

/// A text such as "12 snapshots: 0.1 GB of memory, 0.02 GB on the disk with -o".
std::string in_words(const Estimate& estimate);

/// \throws InputError if a run needs more memory than this process may have. The error states both numbers. If several
/// processes share a chain, `share_of_machine` is the part on this machine.
void require_memory(const Scenario& scenario, const pulse::Problem& problem);
void require_memory(const Scenario& scenario, const chain::ScaledProblem& chain, double share_of_machine = 1);
void require_memory(const Scenario& scenario, const std::vector<chain::ScaledProblem>& chains);

}  // namespace slipfront::scenario
