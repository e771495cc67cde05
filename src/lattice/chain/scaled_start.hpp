#pragma once

#include <memory>

#include "lattice/chain/model/initial_train.hpp"
#include "slipfront/lattice/chain/chain.hpp"
#include "slipfront/lattice/chain/run.hpp"

namespace slipfront::chain {

/// A scaled problem in the chain's own units, with its initial train.
struct ScaledStart {
  Problem problem;
  StaticTrain train;
};

/// The charge of a ring is that of its train. \throws InputError as `problem_of` and StaticTrain do.
ScaledStart scaled_start(const ScaledProblem& scaled, double share_of_machine = 1);
/// (all) All ranks throw the same error together.
ScaledStart scaled_start(const ScaledProblem& scaled, const Execution& execution);

/// A chain of the steps that the problem asks for. \throws InputError as ExplicitChain and ImplicitChain do.
std::unique_ptr<Chain> make_chain(const Problem& problem, const MotionOf& start, const Execution& execution = {});

}  // namespace slipfront::chain
