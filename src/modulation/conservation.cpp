#include "slipfront/modulation/conservation.hpp"

#include "slipfront/train/train.hpp"

namespace slipfront::modulation {

Pair density(const State& state) {
  const train::Averages a = train::averages(state);
  return {a.k, a.P};
}

Pair flux(const State& state) {
  const train::Averages a = train::averages(state);
  return {a.W, a.Q};
}

}  // namespace slipfront::modulation
