#include <cmath>

#include "slipfront/rupture/relations.hpp"
#include "slipfront/rupture/riemann.hpp"
#include "slipfront/train/train.hpp"

namespace slipfront::rupture {

RiemannSolution slip_pulse(double stress) { return solve_riemann({0, from_stress(stress).psi}, State{}); }

ProfilePoint profile_point(const RiemannSolution& pulse, double x_over_t) {
  const State state = sample(pulse, x_over_t);
  const train::Averages a = train::averages(state);
  return {state.empty() ? 0.0 : std::tanh(state.phi), a.k, a.W, a.P};
}

}  // namespace slipfront::rupture
