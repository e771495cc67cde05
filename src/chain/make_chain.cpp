#include "chain/make_chain.hpp"

#include "chain/explicit/explicit_chain.hpp"
#include "chain/implicit/implicit_chain.hpp"

namespace slipfront::chain {

std::unique_ptr<Chain> make_chain(const Problem& problem, const MotionOf& start, const Execution& execution) {
  if (problem.implicit) return std::make_unique<ImplicitChain>(problem, start, execution);
  return std::make_unique<ExplicitChain>(problem, start, execution);
}

}  // namespace slipfront::chain
