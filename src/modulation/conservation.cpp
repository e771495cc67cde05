#include "slipfront/modulation/conservation.hpp"

#include "modulation/equations.hpp"
#include "slipfront/train/train.hpp"

namespace slipfront::modulation {

Pair density(const State& state) {
  const train::Averages a = train::averages(state);
  return {a.k, a.P};
}

Pair flux(const State& state) {
  if (state.empty()) return {0, 0};
  const Pair at = density(state);
  const auto [U, p] = fluxes(state.phi, state.psi);
  return {U * at.number, U * at.momentum + p};
}

}  // namespace slipfront::modulation
